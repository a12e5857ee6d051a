#include "renderer/methods/ambient_occlusion/ambient_occlusion.h"

#include <algorithm>
#include <atomic>

#include <tbb/parallel_for.h>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/methods/ambient_occlusion/accessibility.h"
#include "renderer/methods/common_parameters.h"
#include "renderer/methods/common_statistics.h"
#include "renderer/methods/stage_timer.h"

namespace lamplighter {
namespace {

// A path is one ray.
struct Parameters : AccessibilityOptions, SampleParameters {};

const ParameterTable<Parameters>& parameterTable() {
  using P = Parameters;
  static const ParameterTable<P> table{
      {&P::radius,
       "radius",
       "Radius",
       "m",
       "Surfaces farther away than this block no light. Longer rays take slightly more time.",
       {0.01, 1000.0, kLogarithmic}},
      {&P::falloff,
       "falloff",
       "Falloff",
       "",
       "How much light a surface nearer than the radius transmits. none: no light. linear, root: "
       "more with its distance, and all light at the radius. none is fastest, because its rays "
       "stop at any "
       "surface.",
       {{"none", Falloff::none}, {"linear", Falloff::linear}, {"root", Falloff::root}}},
      seedParameters(),
      sampleParameters()};
  return table;
}

constexpr StageSpec kAmbientOcclusionStages[] = {kPathsStage};

struct AmbientOcclusionStats : GiStats {
  int samples = 0;  // per pixel, in this frame
};

const StatisticTable<AmbientOcclusionStats>& statisticTable() {
  static const StatisticTable<AmbientOcclusionStats> table{
      {&AmbientOcclusionStats::samples,
       {.name = "samples_added",
        .label = "Samples added",
        .unit = "samples per pixel",
        .meaning = "Rays that were traced for each pixel.",
        .kind = StatisticKind::work,
        .inTimeline = true,
        .budget = "samples_per_frame",
        .stages = {kPathsStage}}},
      commonStatistics()};
  return table;
}

constexpr char kView[] = "accessibility";

// Adds some rays per pixel each frame until there are enough; restarts when anything changes.
class AmbientOcclusion final : public GiMethod {
 public:
  GiOutput render(const FrameInputs& in) override {
    AmbientOcclusionStats stats;
    StageTimer timer(in, kAmbientOcclusionStages, stats);
    const Parameters parameters = parameterTable().read(in.settings);
    const bool isSame = !sum_.empty() && in.changes.none() && in.view == view_ &&
                        AccessibilityOptions(parameters) == options_ &&
                        samples_ <= parameters.samplesPerPixel;
    if (!isSame) {
      view_ = in.view;
      options_ = parameters;
      sum_.assign(static_cast<size_t>(view_.width) * static_cast<size_t>(view_.height), 0.0f);
      samples_ = 0;
    }
    const int until = std::min(parameters.samplesPerPixel, samples_ + parameters.samplesPerFrame);
    const bool isMore = until > samples_;
    if (!isSame) in.backend.renderGBuffer(in.view, vec2(0.0f));
    stats.samples = until - samples_;
    if (isMore) stats.raysTraced = addSamples(in, until);
    if (isMore || in.lightOnly != lightOnly_ || in.part != part_) picture_ = compose(in);
    lightOnly_ = in.lightOnly;
    part_ = in.part;

    stats.samplesPerPixel = samples_;
    stats.framesUntilSettled =
        (parameters.samplesPerPixel - samples_ + parameters.samplesPerFrame - 1) /
        parameters.samplesPerFrame;
    timer.end(kPathsStage);

    GiOutput out;
    out.radiance = picture_;
    out.settled = samples_ == parameters.samplesPerPixel;
    out.stats = published(stats, statisticTable());
    return out;
  }

  void reset() override { *this = AmbientOcclusion(); }

  Inspection inspect() const override {
    Inspection out;
    out.pictures[kView] = [this] { return greyPicture(); };
    return out;
  }

 private:
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(view_.width) + static_cast<size_t>(x);
  }

  // The samples of a pixel are added in order, so neither the number of threads nor the
  // distribution over frames changes a bit. Returns the number of rays.
  uint64_t addSamples(const FrameInputs& in, int until) {
    const GBufferView gbuffer = in.backend.hostGBuffer();
    const RayCaster& rays = in.services.rays();
    std::atomic<uint64_t> pixels = 0;
    tbb::parallel_for(0, view_.height, [&](int y) {
      uint64_t hits = 0;
      for (int x = 0; x < view_.width; ++x) {
        if (!gbuffer.isHit(x, y)) continue;
        ++hits;
        const GBufferPoint p = gbuffer.at(x, y);
        const size_t i = index(x, y);
        for (int sample = samples_; sample < until; ++sample)
          sum_[i] += sampleAccessibility(rays, p.position, p.normal, p.geometricNormal,
                                         static_cast<uint32_t>(i), static_cast<uint32_t>(sample),
                                         options_);
      }
      pixels += hits;
    });
    return pixels * static_cast<uint64_t>(until - std::exchange(samples_, until));
  }

  // The light of a sky of radiance 1 W/(m² sr): E = π A. It is direct light.
  std::shared_ptr<RadianceImage> compose(const FrameInputs& in) const {
    if (in.part == LightPart::indirect)
      return std::make_shared<HostImage>(Image(view_.width, view_.height));
    Image irradiance(view_.width, view_.height);
    for (size_t i = 0; i < sum_.size(); ++i) irradiance.pixels[i] = vec3(kPi * mean(i));
    return in.backend.compose(irradiance, in.lightOnly);
  }

  float mean(size_t i) const { return sum_[i] / static_cast<float>(std::max(samples_, 1)); }

  ViewPicture greyPicture() const {
    ViewPicture out;
    out.image = Image8(view_.width, view_.height);
    for (size_t i = 0; i < sum_.size(); ++i)
      std::fill_n(&out.image.pixels[4 * i], 3,
                  static_cast<uint8_t>(255.0f * std::min(mean(i), 1.0f) + 0.5f));
    out.legend.title = "Accessibility";
    out.legend.ramp = {vec3(0.0f), vec3(1.0f)};
    out.legend.low = "0";
    out.legend.high = "1";
    return out;
  }

  View view_;
  AccessibilityOptions options_;
  std::vector<float> sum_;  // by pixel: of the samples
  int samples_ = 0;
  bool lightOnly_ = false;
  LightPart part_ = LightPart::all;
  std::shared_ptr<RadianceImage> picture_;
};

}  // namespace

MethodInfo ambientOcclusionInfo() {
  return {
      "ambient_occlusion",
      "Ambient occlusion",
      "S. Zhukov, A. Iones, G. Kronin: An ambient light illumination model. Eurographics "
      "Rendering Workshop 1998.",
      parameterTable().specs(),
      statisticTable().specs(),
      {std::begin(kAmbientOcclusionStages), std::end(kAmbientOcclusionStages)},
      [](Backend&) { return std::make_unique<AmbientOcclusion>(); },
      {{Service::rays}},
      {},
      {{kView, "Accessibility",
        "The share of the light of a uniform sky that near surfaces do not block, from 0 to 1."}}};
}

}  // namespace lamplighter
