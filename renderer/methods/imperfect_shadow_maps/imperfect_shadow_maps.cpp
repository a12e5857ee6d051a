#include "renderer/methods/imperfect_shadow_maps/imperfect_shadow_maps.h"

#include <algorithm>
#include <string>

#include "renderer/methods/imperfect_light/imperfect_picture.h"
#include "renderer/methods/imperfect_light/imperfect_views.h"
#include "renderer/methods/imperfect_light/stages.h"
#include "renderer/methods/imperfect_shadow_maps/statistics.h"
#include "renderer/methods/many_lights/many_lights.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/methods/many_lights/stages.h"

namespace lamplighter {
namespace {

// The stages of many_lights without light on surfaces, then those of bounced light.
std::vector<StageSpec> stagesOf() {
  std::vector<StageSpec> all(std::begin(kManyLightsStages), std::end(kManyLightsStages));
  std::erase(all, kMeshesStage);
  all.insert(all.end(), std::begin(kImperfectStages), std::end(kImperfectStages));
  return all;
}

// Direct light is that of many_lights, whose parameters have the same names.
std::vector<ParameterSpec> parameterSpecs() {
  std::vector<ParameterSpec> specs = imperfectParameters().specs();
  const auto& direct = directSampleParameters().specs();
  specs.insert(specs.end(), direct.begin(), direct.end());
  return specs;
}

class ImperfectShadowMaps final : public GiMethod {
 public:
  explicit ImperfectShadowMaps(ManyLightsKernels& kernels) : direct_(kernels) {}

  GiOutput render(const FrameInputs& in) override {
    const ImperfectParameters parameters = imperfectParameters().read(in.settings).chosen();
    Settings settings = in.settings;
    settings.set("indirect", std::string("samples"));
    settings.set("bounces", 0);
    GiOutput out = direct_.render({in.scene, in.changes, in.view, in.backend, in.services, settings,
                                   in.frame, in.stopwatch, in.stageTimes, in.lightOnly, in.part});
    ImperfectStats stats;
    static_cast<GiStats&>(stats) = out.stats;
    std::erase_if(stats.stageSeconds,
                  [](const StageTime& time) { return time.stage == kMeshesStage; });
    stats.lightSamples = static_cast<int>(out.stats.of("vpls"));
    if (parameters.bounces > 0)
      addBounced(in, parameters, out, stats);
    else
      bounced_.forget();
    stats.take(bounced_);
    if (!out.settled && in.part != LightPart::direct && parameters.bounces > 0)
      stats.framesUntilSettled = std::max(1, stats.framesUntilSettled + bounced_.framesLeft());
    out.stats = published(stats, imperfectStatistics());
    return out;
  }

  void reset() override {
    direct_.reset();
    bounced_.forget();
  }
  Inspection inspect() const override {
    Inspection out = direct_.inspect();
    out.pictures = imperfectPictures(bounced_);
    return out;
  }

 private:
  void addBounced(const FrameInputs& in, const ImperfectParameters& parameters, GiOutput& out,
                  ImperfectStats& stats) {
    const size_t first = stats.stageSeconds.size();
    double last = 0.0;
    if (in.stopwatch) {
      for (const StageSpec& stage : kImperfectStages) stats.stageSeconds.push_back({stage, 0.0});
      last = in.stopwatch();
    }
    const EndStage endStage = [&](const StageSpec& stage) {
      if (!in.stopwatch) return;
      const double now = in.stopwatch();
      for (size_t i = first; i < stats.stageSeconds.size(); ++i)
        if (stats.stageSeconds[i].stage == stage) stats.stageSeconds[i].seconds += now - last;
      last = now;
    };
    bounced_.update(in, parameters, endStage);
    if (in.part == LightPart::direct) return;
    ImperfectPicture::Direct direct{out.radiance, out.settled, {}, &direct_.gbufferIsCurrent()};
    if (out.settled) direct.lights = liveSamples(direct_.inspect().lights);
    out.radiance =
        bounced_.addTo(in, direct, manyLightsParameters().read(in.settings).antialias,
                       {in.lightOnly, parameters.speculars, parameters.leastRoughness}, endStage);
    out.settled = out.settled && bounced_.isDone();
    out.refined = out.refined && out.settled;
  }

  ManyLights direct_;
  ImperfectPicture bounced_;
};

}  // namespace

MethodInfo imperfectShadowMapsInfo() {
  const MethodInfo lights = manyLightsInfo();
  return {"imperfect_shadow_maps",
          "Imperfect shadow maps",
          "Ritschel et al., Making Imperfect Shadow Maps View-Adaptive, 2011 (paper 2)",
          parameterSpecs(),
          imperfectStatistics().specs(),
          stagesOf(),
          [](Backend& backend) {
            return std::make_unique<ImperfectShadowMaps>(
                backend.kernels<ManyLightsKernels>("imperfect_shadow_maps"));
          },
          lights.needs,
          {{Capability::lights, ""}, {Capability::patches, ""}, {Capability::texels, ""}},
          imperfectViews()};
}

}  // namespace lamplighter
