#include "renderer/methods/multi_mesh/multi_mesh.h"

#include <string>

#include "renderer/methods/many_lights/many_lights.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/methods/many_lights/stages.h"

namespace lamplighter {
namespace {

// Direct light is that of many_lights, whose parameters have the same names.
const ParameterTable<ManyLightsParameters>& parameterTable() {
  static const ParameterTable<ManyLightsParameters> table{
      manyLightsParameters().only("vpls"),
      pathParameters(),
      frameBudgetParameters(),
      surfaceLightParameters(),
      surfaceParameters(),
      manyLightsParameters().only("antialias"),
      manyLightsParameters().only("share_memory"),
      manyLightsParameters().only("refine")};
  return table;
}

struct MultiMeshStats : SurfaceLightStats {
  int lightSamples = 0;  // of direct light
};

const StatisticTable<MultiMeshStats>& statisticTable() {
  using S = MultiMeshStats;
  static const StatisticTable<S> table{
      surfaceLightStatistics(),
      {&S::lightSamples,
       {.name = "light_samples",
        .label = "Light samples",
        .unit = "samples",
        .meaning = "Light samples on the lights, for direct light at pixels."}},
      commonStatistics()};
  return table;
}

class MultiMesh final : public GiMethod {
 public:
  explicit MultiMesh(ManyLightsKernels& kernels) : lights_(kernels) {}

  GiOutput render(const FrameInputs& in) override {
    Settings settings = in.settings;
    settings.set("indirect", std::string("meshes"));
    GiOutput out = lights_.render({in.scene, in.changes, in.view, in.backend, in.services, settings,
                                   in.frame, in.stopwatch, in.stageTimes, in.lightOnly, in.part});
    MultiMeshStats stats;
    static_cast<GiStats&>(stats) = out.stats;
    stats.take(lights_.surfaceCounts());
    stats.lightSamples = static_cast<int>(out.stats.of("vpls"));
    out.stats = published(stats, statisticTable());
    return out;
  }

  void reset() override { lights_.reset(); }
  Inspection inspect() const override { return lights_.inspect(); }

 private:
  ManyLights lights_;
};

}  // namespace

MethodInfo multiMeshInfo() {
  const MethodInfo lights = manyLightsInfo();
  return {"multi_mesh",
          "Light on surfaces",
          "Multi-mesh caching: progressive rendering with irradiance at the vertices of meshes "
          "(paper 4)",
          parameterTable().specs(),
          statisticTable().specs(),
          kManyLightsStages,
          [](Backend& backend) {
            return std::make_unique<MultiMesh>(backend.kernels<ManyLightsKernels>("multi_mesh"));
          },
          lights.needs,
          {{Capability::lights, ""},
           {Capability::patches, ""},
           {Capability::texels, ""},
           {Capability::elements, ""}}};
}

}  // namespace lamplighter
