#include "renderer/methods/light_field/light_field_method.h"

#include <string>

#include "renderer/methods/field_light/field_views.h"
#include "renderer/methods/field_light/parameters.h"
#include "renderer/methods/many_lights/many_lights.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/methods/many_lights/stages.h"

namespace lamplighter {
namespace {

// The parameters of many_lights that matter when a field carries bounced light.
struct FieldMethodParameters : PathParameters,
                               FrameBudgetParameters,
                               SurfaceParameters,
                               LightFieldParameters {};

std::vector<ParameterSpec> fieldMethodSpecs() {
  static const ParameterTable<FieldMethodParameters> own{
      pathParameters(), frameBudgetParameters(), surfaceParameters(), lightFieldParameters()};
  std::vector<ParameterSpec> specs = own.specs();
  const auto& direct = directSampleParameters().specs();
  specs.insert(specs.end(), direct.begin(), direct.end());
  return specs;
}

struct FieldMethodStats : GiStats, LightFieldStats {
  int lightSamples = 0;
};

const StatisticTable<FieldMethodStats>& fieldMethodStatistics() {
  static const StatisticTable<FieldMethodStats> table{
      {&FieldMethodStats::lightSamples,
       {.name = "light_samples",
        .label = "Light samples",
        .unit = "samples",
        .meaning = "Light samples on the lights, for direct light at pixels."}},
      lightFieldStatistics(),
      commonStatistics()};
  return table;
}

class LightFieldMethod final : public GiMethod {
 public:
  explicit LightFieldMethod(ManyLightsKernels& kernels) : lights_(kernels) {}

  GiOutput render(const FrameInputs& in) override {
    Settings settings = in.settings;
    settings.set("indirect", std::string("field"));
    GiOutput out = lights_.render({in.scene, in.changes, in.view, in.backend, in.services, settings,
                                   in.frame, in.stopwatch, in.stageTimes, in.lightOnly, in.part});
    FieldMethodStats stats;
    static_cast<GiStats&>(stats) = out.stats;
    stats.lightSamples = static_cast<int>(out.stats.of("vpls"));
    stats.take(lights_.field().light());
    out.stats = published(stats, fieldMethodStatistics());
    return out;
  }
  void reset() override { lights_.reset(); }
  Inspection inspect() const override {
    Inspection out = lights_.inspect();
    out.pictures = lights_.field().views();
    return out;
  }

 private:
  ManyLights lights_;
};

}  // namespace

MethodInfo lightFieldInfo() {
  const MethodInfo lights = manyLightsInfo();
  return {"light_field",
          "Light field",
          "The virtual light field on the GPU (paper 5)",
          fieldMethodSpecs(),
          fieldMethodStatistics().specs(),
          {std::begin(kManyLightsStages), std::end(kManyLightsStages)},
          [](Backend& backend) {
            return std::make_unique<LightFieldMethod>(
                backend.kernels<ManyLightsKernels>("light_field"));
          },
          lights.needs,
          {{Capability::lights, ""}, {Capability::patches, ""}, {Capability::texels, ""}},
          fieldViews()};
}

}  // namespace lamplighter
