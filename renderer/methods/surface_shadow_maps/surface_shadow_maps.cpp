#include "renderer/methods/surface_shadow_maps/surface_shadow_maps.h"

#include <string>

#include "renderer/methods/many_lights/many_lights.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/methods/many_lights/stages.h"
#include "renderer/methods/texel_views.h"

namespace lamplighter {
namespace {

constexpr char kVisibility[] = "link_visibility", kStored[] = "stored";

// The parameters of many_lights that matter when links carry bounced light.
struct Parameters : PathParameters,
                    FrameBudgetParameters,
                    SurfaceParameters,
                    StoredDepthParameters {};

std::vector<ParameterSpec> parameterSpecs() {
  static const ParameterTable<Parameters> own{pathParameters(), frameBudgetParameters(),
                                              surfaceParameters(), storedDepthParameters()};
  std::vector<ParameterSpec> specs = own.specs();
  const auto& direct = directSampleParameters().specs();
  specs.insert(specs.end(), direct.begin(), direct.end());
  // As published; rays are the default of many_lights.
  for (ParameterSpec& spec : specs)
    if (spec.name == kVisibility) spec.defaultValue = std::string(kStored);
  return specs;
}

struct Stats : GiStats, StoredDepthStats {
  int lightSamples = 0;
};

const StatisticTable<Stats>& statisticTable() {
  static const StatisticTable<Stats> table{
      {&Stats::lightSamples,
       {.name = "light_samples",
        .label = "Light samples",
        .unit = "samples",
        .meaning = "Light samples on the lights, for direct light at pixels."}},
      storedDepthStatistics(),
      commonStatistics()};
  return table;
}

class SurfaceShadowMaps final : public GiMethod {
 public:
  explicit SurfaceShadowMaps(ManyLightsKernels& kernels) : lights_(kernels) {}

  GiOutput render(const FrameInputs& in) override {
    Settings settings = in.settings;
    settings.set("indirect", std::string("links"));
    if (!settings.values().contains(kVisibility)) settings.set(kVisibility, std::string(kStored));
    GiOutput out = lights_.render({in.scene, in.changes, in.view, in.backend, in.services, settings,
                                   in.frame, in.stopwatch, in.stageTimes, in.lightOnly, in.part});
    Stats stats;
    static_cast<GiStats&>(stats) = out.stats;
    stats.lightSamples = static_cast<int>(out.stats.of("vpls"));
    stats.take(lights_.linked().light());
    out.stats = published(stats, statisticTable());
    return out;
  }
  void reset() override { lights_.reset(); }
  Inspection inspect() const override {
    Inspection out = lights_.inspect();
    out.pictures = lights_.linked().views();
    return out;
  }

 private:
  ManyLights lights_;
};

}  // namespace

MethodInfo surfaceShadowMapsInfo() {
  const MethodInfo lights = manyLightsInfo();
  return {"surface_shadow_maps",
          "Surface shadow maps",
          "Coherent surface shadow maps: visibility stored on the surfaces, and hierarchical "
          "radiosity (paper 3)",
          parameterSpecs(),
          statisticTable().specs(),
          {std::begin(kManyLightsStages), std::end(kManyLightsStages)},
          [](Backend& backend) {
            return std::make_unique<SurfaceShadowMaps>(
                backend.kernels<ManyLightsKernels>("surface_shadow_maps"));
          },
          lights.needs,
          {{Capability::lights, ""},
           {Capability::patches, ""},
           {Capability::texels, ""},
           {Capability::links, ""}},
          texelViews()};
}

}  // namespace lamplighter
