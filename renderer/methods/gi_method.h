// The interface of all global illumination methods, including the path tracer.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/backends/backend.h"
#include "renderer/base/parameters.h"
#include "renderer/methods/inspection.h"
#include "renderer/methods/light_part.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"
#include "renderer/services/services.h"

namespace lamplighter {

// The caller supplies the stopwatch that measures the stages (null: not measured), so that no
// method reads a clock. Measured times never influence the result.
using Stopwatch = std::function<double()>;  // seconds since some fixed moment

// The input of a method for one frame. The scene, the backend and the services are up to date when
// render() is called.
struct FrameInputs {
  const RenderScene& scene;
  const RenderSceneChanges& changes;  // since the previous frame
  const View& view;
  Backend& backend;
  Services& services;
  const Settings& settings;
  uint32_t frame = 0;  // counts from 0
  Stopwatch stopwatch;
  bool lightOnly = false;           // visible surfaces are shown white; bounces use the real albedo
  LightPart part = LightPart::all;  // the light in the picture; a picture of a part is not refined
};

struct GiStats {
  int vpls = 0;                // shown
  int vplsPending = 0;         // not yet as the scene requires
  int mapsPending = 0;         // of these, VPLs whose map must be rendered
  int mapsToSharpen = 0;       // coarse maps that become fine when nothing is pending
  int oldestFrames = 0;        // frames that the oldest pending VPL has waited
  int framesUntilSettled = 0;  // estimate at this frame's rate, without further changes
  int vplsRefreshed = 0;       // this frame
  int mapsRendered = 0;        // in this frame, except fine maps
  int mapsSharpened = 0;       // in this frame: fine maps rendered
  int mapsHeld = 0;            // of shown VPLs
  int mapsWithoutRoom = 0;     // needed maps that do not fit; their VPLs use proxies
  // bytes, if the visibility database does not fit and is not used; else 0
  uint64_t visibilityNeeds = 0;
  int mapsSpared = 0;  // in this frame: a mover was hidden from the light, so its map stays valid
  // Paths of indirect light in this frame: traced again; of these, the ones that hit something else
  // now; the ones that were kept. And paths that wait.
  int pathsWalked = 0, pathsReplaced = 0, pathsKept = 0, pathsPending = 0;
  uint64_t raysTraced = 0;       // in this frame, by the method
  uint64_t visibilityTests = 0;  // in this frame: occlusion pyramids against the scene
  uint64_t lightMapTexels = 0;   // in this frame: texels × lights added or subtracted
  float lightMapTexel = 0.0f;    // texel spacing that memory allows [m]; 0: no light maps
  // Of the last sum, with merged passes: the number drawn, and the number saved.
  int mergedPasses = 0, passesSaved = 0;
  // share of pixels that the low-resolution pass interpolated in the last sum
  float interpolatedShare = 0.0f;
  int transfersPending = 0;    // transfers of objects that are being computed
  float transferShare = 1.0f;  // progress of the first of them
  // Objects with transfer; of these, objects whose pixels sum all direct light, because the error
  // of transfer would be too large; lights that pixels sum for this reason, counted once per other
  // object. Then: objects without transfer because memory is short.
  int transferObjects = 0, transferObjectsLeft = 0, transferLightsLeft = 0;
  int transferObjectsWithoutRoom = 0;
  int samplesPerPixel = 0;
  // Refinement of a settled picture: the number of VPLs in the mean, the target number, and the
  // VPLs added in this frame.
  int vplsRefined = 0, vplsToRefine = 0, mapsRefined = 0;
  std::map<std::string, double> stageSeconds;   // by stage name
  std::map<std::string, uint64_t> memoryBytes;  // memory of the method, by purpose
};

struct GiOutput {
  std::shared_ptr<RadianceImage> radiance;
  bool includesDirect = true;
  bool settled = false;  // rendering the same input again would at most refine the picture
  bool refined = true;   // the picture is refined as far as requested, or refinement is off
  GiStats stats;
};

class GiMethod {
 public:
  virtual ~GiMethod() = default;
  virtual GiOutput render(const FrameInputs& in) = 0;
  // Discards everything that is kept between frames.
  virtual void reset() = 0;
  // Internal data for debug views. Valid until the next call of another function.
  virtual Inspection inspect() const { return {}; }
};

// A debug view that a method draws itself (Inspection::pictures).
struct MethodView {
  std::string name;   // for --view; no other view has it
  std::string label;  // in the menu
  std::string help;   // one sentence
};

// A capability of Inspection that the method has, and when: "with technique light_maps"; "":
// always.
struct ShownCapability {
  Capability capability;
  std::string when;
};

// Kernels that a method needs of the backend.
struct KernelNeed {
  std::string name;
  bool (*isMetBy)(const Backend&);
};
template <typename Interface>
KernelNeed kernelNeed(std::string name) {
  return {std::move(name), [](const Backend& backend) { return backend.offers<Interface>(); }};
}

struct MethodNeeds {
  std::vector<Service> services = {};  // all that it may ask for
  std::vector<KernelNeed> kernels = {};
  bool openGl = false;  // it draws with OpenGL itself, so only on the gl backend
};

struct MethodInfo {
  std::string name;      // for --method
  std::string label;     // in the panel
  std::string citation;  // of the paper
  std::vector<ParameterSpec> parameters;
  // The method on this backend, which must meet its needs and outlive it.
  std::function<std::unique_ptr<GiMethod>(Backend&)> make;
  MethodNeeds needs = {};
  std::vector<ShownCapability> shows = {};  // besides its own views
  std::vector<MethodView> views = {};       // its own
};

}  // namespace lamplighter
