#include "renderer/methods/path_tracer/reference_method.h"

#include <algorithm>
#include <atomic>

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include "renderer/methods/common_statistics.h"
#include "renderer/methods/path_tracer/parameters.h"
#include "renderer/methods/stage_timer.h"

namespace lamplighter {

namespace {

constexpr StageSpec kPathTracerStages[] = {kPathsStage};

struct PathTracerStats : GiStats {
  int paths = 0;  // per pixel, in this frame
};

const StatisticTable<PathTracerStats>& pathTracerStatistics() {
  static const StatisticTable<PathTracerStats> table{
      {&PathTracerStats::paths,
       {.name = "paths_per_pixel",
        .label = "Paths per pixel",
        .unit = "paths per pixel",
        .meaning = "Paths that were traced for each pixel.",
        .kind = StatisticKind::work,
        .budget = "samples_per_frame",
        .stages = {kPathsStage}}},
      commonStatistics()};
  return table;
}

// Adds some paths per pixel each frame until there are enough; restarts when anything changes.
class ReferenceMethod final : public GiMethod {
 public:
  GiOutput render(const FrameInputs& in) override {
    PathTracerStats stats;
    StageTimer timer(in, kPathTracerStages, stats);
    const PathTracerParameters parameters = pathTracerParameters().read(in.settings);
    const bool sameScene = in.changes.none() && sum_.width != 0;
    if (!sameScene) lights_ = LightSet::forPaths(in.scene, lights_);
    PathTracerOptions options = parameters.options(in.lightOnly);
    options.part = in.part;
    const int wanted = parameters.samplesPerPixel;
    const bool samePaths = options == options_;
    // If fewer paths are wanted than there are, it also restarts, so that the picture has the exact
    // count.
    if (!sameScene || !(in.view == view_) || !samePaths || wanted < samples_) {
      view_ = in.view;
      options_ = options;
      sum_ = Image(view_.width, view_.height);
      samples_ = 0;
    }

    const int next = std::min(wanted, samples_ + parameters.samplesPerFrame);
    if (next > samples_) {
      stats.paths = next - samples_;
      stats.raysTraced = addSamples(in, next);
      picture_ = std::make_shared<HostImage>(mean());
    }

    GiOutput out;
    out.radiance = picture_;
    out.settled = samples_ >= wanted;
    stats.samplesPerPixel = samples_;
    const int aFrame = std::max(1, parameters.samplesPerFrame);
    stats.framesUntilSettled = (std::max(0, wanted - samples_) + aFrame - 1) / aFrame;
    timer.end(kPathsStage);
    out.stats = published(stats, pathTracerStatistics());
    return out;
  }

  void reset() override { sum_ = Image(); }

 private:
  // Tiles are fixed, and the samples of a pixel are added in order, so neither the number of
  // threads nor the distribution over frames changes a bit. Returns the number of rays.
  uint64_t addSamples(const FrameInputs& in, int until) {
    const tbb::blocked_range2d<int> pixels(0, view_.height, 16, 0, view_.width, 16);
    const RayCaster& caster = in.services.rays();
    std::atomic<uint64_t> rays = 0;
    tbb::parallel_for(pixels, [&](const tbb::blocked_range2d<int>& tile) {
      uint64_t here = 0;
      for (int y = tile.rows().begin(); y < tile.rows().end(); ++y) {
        for (int x = tile.cols().begin(); x < tile.cols().end(); ++x) {
          for (int i = samples_; i < until; ++i) {
            sum_.at(x, y) += tracePath(in.scene, caster, lights_, view_, x, y,
                                       static_cast<uint32_t>(i), options_, &here);
          }
        }
      }
      rays += here;
    });
    samples_ = until;
    return rays;
  }

  Image mean() const {
    Image m = sum_;
    for (vec3& p : m.pixels) p /= static_cast<float>(samples_);
    return m;
  }

  LightSet lights_;
  View view_;
  PathTracerOptions options_;
  Image sum_;
  int samples_ = 0;
  std::shared_ptr<RadianceImage> picture_;
};

}  // namespace

const ParameterTable<PathTracerParameters>& pathTracerParameters() {
  static const ParameterTable<PathTracerParameters> table{
      pathParameters(),
      sampleParameters(),
      surfaceParameters(),
      {&PathTracerParameters::glossyBounces, "glossy_bounces", "Glossy bounces",
       "Bounces reflect light by metallic and roughness values, too, so that mirrors show mirrors, "
       "and metal throws caustics. Off: bounces are diffuse. Needs more paths for the same noise.",
       ParameterGroup::picture}};
  return table;
}

MethodInfo referenceInfo() {
  return {kReferenceMethod,
          "Reference (path tracing)",
          "J. T. Kajiya: The rendering equation. SIGGRAPH 1986. Light sampling combined as in E. "
          "Veach and L. Guibas: "
          "Optimally combining sampling techniques for Monte Carlo rendering. SIGGRAPH 1995.",
          pathTracerParameters().specs(),
          pathTracerStatistics().specs(),
          {std::begin(kPathTracerStages), std::end(kPathTracerStages)},
          [](Backend&) { return std::make_unique<ReferenceMethod>(); },
          {{Service::rays}}};
}

}  // namespace lamplighter
