// Bakes light maps, vertex colours or light probes from the command line, on one machine or on
// several.
#include <charconv>
#include <functional>
#include <iostream>

#include <spdlog/fmt/fmt.h>

#include "editor/bake/bake_job.h"
#include "editor/bake/bake_methods.h"
#include "editor/bake/probe_job.h"
#include "editor/bake/vertex_colour_job.h"
#include "editor/cli/options.h"
#include "editor/cli/progress_line.h"
#include "editor/cli/subcommands.h"
#include "renderer/base/error.h"
#include "renderer/base/threads.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/probes/probe_file.h"
#include "renderer/registry/registry.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter::cli {
namespace {

constexpr int kCancelled = 130;  // as shells report Ctrl+C
constexpr int kMostShards = 100000;
// If standard error is not a terminal, prints a line after each tenth of the work.
constexpr int kTenths = 10;

// "2/8": the second of eight. Throws InputError.
std::pair<int, int> parseShard(const std::string& text) {
  int shard = 0, shards = 0;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == '/') {
    const auto second = std::from_chars(first.ptr + 1, end, shards);
    if (second.ec == std::errc() && second.ptr == end && shard >= 1 && shard <= shards &&
        shards <= kMostShards)
      return {shard, shards};
  }
  throw InputError("--shard", "'" + text + "' is not a shard such as 2/8",
                   "give a number from 1 to n, a slash and n");
}

std::string timeText(double seconds) {
  const int s = static_cast<int>(seconds + 0.5);
  if (s >= 3600) return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
  return s >= 60 ? fmt::format("{} min {:02} s", s / 60, s % 60) : fmt::format("{} s", s);
}

// Options of the texels of --visibility; parameters that the method does not have get their
// defaults.
TexelRadiosityOptions visibilityOf(const Settings& settings) {
  return manyLightsParameters().read(settings).radiosity(0, 1);
}

// Shows how far the work is, and stops it by Ctrl+C. `parts`: what is counted.
class ShownProgress {
 public:
  ShownProgress(const Frontend& frontend, std::string parts)
      : frontend_(frontend),
        parts_(std::move(parts)),
        isInterrupted_(frontend.catchInterrupts()),
        start_(frontend.stopwatch()) {}

  bool operator()(int done, int all) {
    const double seconds = frontend_.stopwatch() - start_;
    const std::string text = fmt::format("bake: {} of {} {}, {} left", done, all, parts_,
                                         timeText(seconds / done * (all - done)));
    line_.show(text);
    if (!line_.isTerminal() && done * kTenths / all > told_) {
      told_ = done * kTenths / all;
      std::cerr << text << '\n';
    }
    return !isInterrupted_();
  }
  void hide() { line_.show(""); }

 private:
  const Frontend& frontend_;
  std::string parts_;
  std::function<bool()> isInterrupted_;
  double start_;
  ProgressLine line_;
  int told_ = 0;
};

int bakeVertexColours(const VertexColourOptions& job, const Scene& scene,
                      const Frontend& frontend) {
  ShownProgress progress(frontend, "nodes");
  const std::optional<LitScene> lit = withVertexColours(scene, job, std::ref(progress));
  progress.hide();
  if (!lit) {
    std::cerr << "bake: stopped; nothing was written\n";
    return kCancelled;
  }
  if (lit->clipped > 0)
    std::cerr << fmt::format(
        "warning: {} vertices are brighter than 1 and were clipped; the "
        "brightest colour is 1 with --exposure auto\n",
        lit->clipped);
  const auto files = writeLitScene(*lit, job);
  std::cout << fmt::format("{} triangles of {} meshes, {} before; colours times {:.4g}\n",
                           lit->triangles, lit->meshes, lit->trianglesBefore, lit->scale);
  for (const auto& file : files) std::cout << file.string() << '\n';
  return 0;
}

int bakeLightMaps(const BakeJobOptions& job, const Scene& scene, const Frontend& frontend) {
  ShownProgress progress(frontend, "tiles");
  const BakeReport report = lamplighter::bake(scene, job, std::ref(progress));
  progress.hide();
  for (const std::string& w : report.warnings) std::cerr << "warning: " << w << '\n';
  if (report.isCancelled) {
    std::cerr << fmt::format("bake: stopped with {} of {} tiles found; the same command goes on\n",
                             report.taken + report.found, report.tiles);
    return kCancelled;
  }
  std::cout << fmt::format("{} tiles of {} pages: {} found now, {} before\n", report.tiles,
                           report.pages, report.found, report.taken);
  for (const auto& file : report.files) std::cout << file.string() << '\n';
  return 0;
}

int bakeLightProbes(const ProbeJobOptions& job, const Scene& scene, const Frontend& frontend) {
  ShownProgress progress(frontend, "probes");
  const std::optional<ProbeReport> report = bakeProbes(scene, job, std::ref(progress));
  progress.hide();
  if (!report) {
    std::cerr << "bake: stopped; no probes were written\n";
    return kCancelled;
  }
  for (const std::string& w : report->warnings) std::cerr << "warning: " << w << '\n';
  std::string counts;
  for (size_t i = 0; i < report->counts.size(); ++i)
    counts += fmt::format("{}{} {}", i == 0 ? "" : ", ", report->counts[i],
                          nameOf(static_cast<ProbeState>(i)));
  std::cout << fmt::format("probes {:.4g} m apart: {}\n", report->spacing, counts);
  for (const auto& file : report->files) std::cout << file.string() << '\n';
  return 0;
}

// Throws InputError if the folder cannot get these files.
void requireFolder(const std::filesystem::path& folder, const std::vector<std::string>& files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw InputError(folder.string(), "cannot be created (" + error.message() + ")",
                     "check the permissions of its parent folder");
  for (const std::string& file : files) requireWritable(folder / file, {});
}

}  // namespace

int bake(const BakeOptions& o, const Frontend& frontend) {
  BakeJobOptions maps;
  maps.atlas = o.atlas;
  const Settings settings = settingsOf(o, findMethod(o.method));
  maps.light = bakeLightOptions(o.method, settings);
  if (!o.shard.empty()) std::tie(maps.shard, maps.shards) = parseShard(o.shard);
  maps.mergeOnly = o.merge;
  maps.keepParts = o.keepParts;
  if (o.visibility) maps.visibility = visibilityOf(settings);
  maps.output = o.output;
  maps.name = std::filesystem::path(o.scene).stem().string();
  VertexColourOptions colours{maps.light, o.vertices, std::nullopt, maps.output, maps.name};
  if (o.exposure != "auto") colours.exposure = exposureOf(o.exposure, Image());
  const ProbeJobOptions probes{o.probeGrid, maps.light.paths, o.probeSamples, maps.output,
                               maps.name};
  std::error_code ignored;
  if (std::filesystem::equivalent(std::filesystem::path(o.scene).parent_path() / ".",
                                  maps.output / ".", ignored))
    throw InputError(o.output, "is the folder of the scene itself, which the copy would replace",
                     "name another folder");

  const ThreadLimit limit(o.threads);
  LoadedScene loaded = loadGltf(o.scene);
  if (o.vertexColours) requireFolder(maps.output, {maps.name + ".gltf", maps.name + "-light.json"});
  if (o.probes) requireFolder(maps.output, probeFileNames(maps.name));
  for (const std::string& w : loaded.warnings) std::cerr << "warning: " << w << '\n';
  int code = 0;
  if (o.vertexColours)
    code = bakeVertexColours(colours, loaded.scene, frontend);
  else if (!o.noMaps)
    code = bakeLightMaps(maps, loaded.scene, frontend);
  if (o.probes && code == 0) code = bakeLightProbes(probes, loaded.scene, frontend);
  return code;
}

}  // namespace lamplighter::cli
