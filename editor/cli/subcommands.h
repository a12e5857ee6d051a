// The subcommands. Each is a function of its parsed options that returns the exit code and may
// throw InputError. cli.cpp parses the flags and reports the errors.
#pragma once

#include <optional>
#include <string>

#include "editor/cli/cli.h"
#include "editor/cli/options.h"
#include "renderer/bake/atlas.h"
#include "renderer/bake/vertex_light.h"
#include "renderer/probes/probe_grid.h"

namespace lamplighter::cli {

struct InfoOptions {
  std::string scene;
  bool json = false;
};
int info(const InfoOptions& options);

struct RenderOptions : MethodFlags {
  std::string scene, output;
  std::string method = "many_lights";
  std::string sky;                             // parseSky(); empty: the scene's own
  std::optional<float> skyRotation, skyScale;  // degrees; only for a sky picture
  std::string camera, size = "1280x720", backend = "auto", stats;
  std::string exposure = "0";  // EV or "auto"
  std::string view = "lit";
  int viewVpl = 0;  // VPL that the debug view shows
  bool legend = false, marks = false;
  int threads = 0;
};
int render(const RenderOptions& options, const Frontend& frontend);

struct MethodsOptions {
  bool json = false, markdown = false;
};
int methods(const MethodsOptions& options);

struct ActionsOptions {
  bool json = false, markdown = false;
};
int actions(const ActionsOptions& options);

struct SettingsOptions {
  bool json = false, markdown = false;
};
int settings(const SettingsOptions& options);

struct CompareOptions {
  std::string a, b, mask, heatmap;
  int block = 1;             // compares means of block × block pixels
  double maxRelRmse = -1.0;  // < 0: not checked
  bool json = false;
};
int compare(const CompareOptions& options);

struct ConvergeOptions : MethodFlags {
  std::string from, to;  // to "": measures from opening `from`
  std::string against, mask;
  std::string method = "many_lights";
  std::string camera, size = "1280x720", backend = "auto";
  int block = 1;                  // as CompareOptions
  std::optional<double> seconds;  // none: until the picture is settled
  int threads = 0;
  bool json = false;
};
int converge(const ConvergeOptions& options, const Frontend& frontend);

struct TilesOptions {
  std::string scene, output;
  std::vector<std::string> sides;  // as for the split view; empty: all methods that show light
  std::string camera, size = "480x270", backend = "auto", exposure = "0";
  int columns = 3;
  std::optional<double> seconds;  // as ConvergeOptions
  int threads = 0;
};
int tiles(const TilesOptions& options, const Frontend& frontend);

struct TonemapOptions {
  std::string input, output, exposure = "0";
};
int tonemap(const TonemapOptions& options);

struct ScriptOptions {
  std::string script, scene;  // scene "": an action opens a scene
  std::string size = "1280x720", backend = "auto";
  std::string journal;  // folder; "": none
  int threads = 0;
};
int script(const ScriptOptions& options, const Frontend& frontend);

struct BakeOptions : MethodFlags {
  std::string scene, output;
  std::string method = "many_lights";
  AtlasOptions atlas;
  std::string shard;  // "i/n", or empty
  bool merge = false, keepParts = false, visibility = false;
  bool vertexColours = false;
  VertexLightOptions vertices;    // of vertex colours
  std::string exposure = "auto";  // EV or "auto"; of vertex colours
  bool probes = false, noMaps = false;
  ProbeGridOptions probeGrid;
  int probeSamples = 1024;  // paths per probe
  int threads = 0;
};
int bake(const BakeOptions& options, const Frontend& frontend);

// "auto" or a number of EV; throws InputError.
float exposureOf(const std::string& text, const Image& radiance);

}  // namespace lamplighter::cli
