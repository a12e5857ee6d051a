// The interface of all global illumination methods, including the path tracer.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/backends/kernels.h"
#include "renderer/base/parameters.h"
#include "renderer/base/statistics.h"
#include "renderer/methods/inspection.h"
#include "renderer/methods/light_part.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// The caller supplies the stopwatch that measures the stages (null: not measured), so that no
// method reads a clock. Measured times never influence the result.
using Stopwatch = std::function<double()>;  // seconds since some fixed moment

// The input of a method for one frame. The scene and the rays are up to date when render() is
// called.
struct FrameInputs {
  const RenderScene& scene;
  const RenderSceneChanges& changes;  // since the previous frame
  const RayCaster& rays;
  const View& view;
  Backend& backend;  // its scene is also up to date
  const Settings& settings;
  uint32_t frame = 0;  // counts from 0
  Stopwatch stopwatch;
  bool lightOnly = false;  // visible surfaces are shown white; bounces use the real albedo
  // If true, slow precomputations may finish some frames later. If false, the frame waits for them,
  // so that every run gives the same frames.
  bool inBackground = false;
  std::filesystem::path cacheFolder;  // for precomputed data; empty: not kept
  // The number of light samples by which this frame may refine a settled picture; 0: no refinement.
  int refineUpdates = 0;
  LightPart part = LightPart::all;  // the light in the picture; a picture of a part is not refined
};

// What every method says of a frame. A method derives a struct with statistics of its own and
// declares them in a table (renderer/base/statistics.h).
struct GiStats {
  int framesUntilSettled = 0;  // estimate at this frame's rate, without further changes
  // Items that were brought up to date in this frame, at most the parameter `updates`; items that
  // wait for it; items by which the settled picture was refined, at most refineUpdates.
  int updates = 0, pending = 0, refineUpdates = 0;
  int samplesPerPixel = 0;
  uint64_t raysTraced = 0;                     // in this frame, by the method
  std::map<std::string, double> stageSeconds;  // by stage name
  std::vector<Statistic> declared;             // in the order of MethodInfo::statistics

  // The value of a declared statistic. Throws std::out_of_range if the method has none of that
  // name.
  double of(std::string_view name) const;
  std::optional<double> find(std::string_view name) const;
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

struct MethodInfo {
  std::string name;      // for --method
  std::string label;     // in the panel
  std::string citation;  // of the paper
  std::vector<ParameterSpec> parameters;
  std::vector<StatisticSpec> statistics;
  std::function<std::unique_ptr<GiMethod>()> make;
};

}  // namespace lamplighter
