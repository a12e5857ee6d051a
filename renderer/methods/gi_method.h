// The interface of all global illumination methods, including the path tracer.
#pragma once

#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/backends/backend.h"
#include "renderer/base/parameters.h"
#include "renderer/base/statistics.h"
#include "renderer/methods/inspection.h"
#include "renderer/methods/light_part.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"
#include "renderer/services/services.h"

namespace lamplighter {

class MirroredLight;

// The caller supplies the stopwatch that measures the stages (null: not measured), so that no
// method reads a clock. Measured times never influence the result.
using Stopwatch = std::function<double()>;  // seconds since some fixed moment

// How stages are timed on a device that works in parallel with the processor. exact: each stage
// waits until the device has finished. late: nothing waits; the time of a stage is the larger of
// the times of the processor and of the device, where the latter is of an earlier frame.
enum class StageTimes : uint8_t { late, exact };

// The input of a method for one frame. The scene, the backend and the services are up to date when
// render() is called.
struct FrameInputs {
  const RenderScene& scene;
  const RenderSceneChanges& changes;  // changes since the previous frame
  const View& view;
  Backend& backend;
  Services& services;
  const Settings& settings;
  uint32_t frame = 0;  // counts from 0
  Stopwatch stopwatch;
  StageTimes stageTimes = StageTimes::late;
  bool lightOnly = false;           // visible surfaces are shown white; bounces use the real albedo
  LightPart part = LightPart::all;  // the light in the picture; a picture of a part is not refined
};

// Statistics of a frame that every method returns. A method derives a struct with more statistics
// and declares them in a table (renderer/base/statistics.h).
struct GiStats {
  int framesUntilSettled = 0;  // estimate at this frame's rate, without further changes
  // Items that were updated in this frame, at most the parameter `updates`; items that wait for an
  // update; items by which the settled picture was refined, at most refineUpdates.
  int updates = 0, pending = 0, refineUpdates = 0;
  // Rows of paths traced to repair the picture before it has settled, at most
  // FrameBudget::previewUpdates.
  int previewUpdates = 0;
  // Limit of this frame for work on light on surfaces, as a share of the usual work of a frame; 0:
  // it did none.
  float surfaceWork = 0.0f;
  int samplesPerPixel = 0;
  uint64_t raysTraced = 0;              // in this frame, by the method
  std::vector<StageTime> stageSeconds;  // as MethodInfo::stages; empty: not measured
  std::vector<Statistic> declared;      // in the order of MethodInfo::statistics
  // By name of a parameter with an automatic value: the choice of the method and the reason.
  std::map<std::string, std::string> chosen;

  double secondsOf(const StageSpec& stage) const;  // 0 if it was not measured

  // The value of a declared statistic. Throws std::out_of_range if the method has no statistic of
  // this name.
  double of(std::string_view name) const;
  std::optional<double> find(std::string_view name) const;
};

// Which edges are antialiased. lights: those of the sky and of lamps. all: also those of surfaces
// in direct light.
enum class SmoothEdges : uint8_t { none, lights, all };

struct GiOutput {
  std::shared_ptr<RadianceImage> radiance;
  bool includesDirect = true;
  bool settled = false;  // rendering the same input again would at most refine the picture
  bool refined = true;   // the picture is refined as far as requested, or refinement is off
  // Edges that are already antialiased, even if the picture has not settled. Antialiasing the same
  // edges again would blur the outlines of bright lamps.
  SmoothEdges smoothEdges = SmoothEdges::none;
  // If the picture has settled: the light that the method stores on surfaces, or null. Valid until
  // the next call of the method.
  std::shared_ptr<const MirroredLight> surfaces;
  GiStats stats;
  // Exception of a background task, reported once. The picture lacks its result.
  std::exception_ptr failure;
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

// A kernel that a method needs from the backend.
struct KernelNeed {
  std::string name;
  bool (*isMetBy)(const Backend&);
};
template <typename Interface>
KernelNeed kernelNeed(std::string name) {
  return {std::move(name), [](const Backend& backend) { return backend.offers<Interface>(); }};
}

struct MethodNeeds {
  std::vector<Service> services = {};  // all services that it may use
  std::vector<KernelNeed> kernels = {};
  bool openGl = false;  // it draws with OpenGL itself, so only on the gl backend
};

struct MethodInfo {
  std::string name;      // for --method
  std::string label;     // in the panel
  std::string citation;  // of the paper
  std::vector<ParameterSpec> parameters;
  std::vector<StatisticSpec> statistics;
  std::vector<StageSpec> stages;  // in the order of a frame
  // The method on this backend, which must meet its needs and outlive it.
  std::function<std::unique_ptr<GiMethod>(Backend&)> make;
  MethodNeeds needs = {};
  std::vector<ShownCapability> shows = {};  // besides its own views
  std::vector<MethodView> views = {};       // its own
  // The parameter whose choices the split view offers as sides of their own; "": none.
  std::string variant = {};
};

}  // namespace lamplighter
