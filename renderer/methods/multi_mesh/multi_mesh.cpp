#include "renderer/methods/multi_mesh/multi_mesh.h"

#include <algorithm>
#include <string>

#include "renderer/methods/many_lights/many_lights.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/methods/many_lights/stages.h"
#include "renderer/methods/multi_mesh/mesh_direct_light.h"
#include "renderer/methods/multi_mesh/parameters.h"

namespace lamplighter {
namespace {

constexpr StageSpec kDirectMeshesStage{
    "direct meshes", "Direct light on meshes",
    "Finding the direct light of area lights at vertices of meshes, and showing it.",
    StageWork::surfaces};

// The stages of many_lights, with this one at the end.
std::vector<StageSpec> stagesOf() {
  std::vector<StageSpec> all(std::begin(kManyLightsStages), std::end(kManyLightsStages));
  all.push_back(kDirectMeshesStage);
  return all;
}

// Direct light of other lights is that of many_lights, whose parameters have the same names.
std::vector<ParameterSpec> parameterSpecs() {
  std::vector<ParameterSpec> specs = multiMeshParameters().specs();
  const auto& more = directSampleParameters().specs();
  specs.insert(specs.end(), more.begin(), more.end());
  return specs;
}

struct MultiMeshStats : SurfaceLightStats {
  int lightSamples = 0;
  int meshes = 0, meshVertices = 0, meshTriangles = 0;
  int directSamples = 0, directMasks = 0, directOpen = 0;
  uint64_t directRays = 0, meshBytes = 0;
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
      {&S::meshes,
       {.name = "light_meshes",
        .label = "Meshes of lights",
        .unit = "meshes",
        .meaning = "Meshes with direct light: one for each area light."}},
      {&S::meshVertices,
       {.name = "mesh_vertices",
        .label = "Vertices of meshes",
        .unit = "vertices",
        .meaning = "Points on the surfaces at which meshes of lights store light."}},
      {&S::meshTriangles,
       {.name = "mesh_triangles",
        .label = "Triangles of meshes",
        .unit = "triangles",
        .meaning = "Triangles of the meshes of lights that the picture shows."}},
      {&S::directSamples,
       {.name = "direct_samples",
        .label = "Vertices lit",
        .unit = "vertices",
        .meaning = "Vertices whose light from one area light was computed in this frame.",
        .kind = StatisticKind::work}},
      {&S::directMasks,
       {.name = "direct_masks",
        .label = "Vertices by masks",
        .unit = "vertices",
        .meaning = "Lit vertices whose visibility was found by a bit mask of the occluders.",
        .kind = StatisticKind::work}},
      {&S::directOpen,
       {.name = "direct_open",
        .label = "Open vertices",
        .unit = "vertices",
        .meaning = "Lit vertices without occluders: no rays and no mask were needed.",
        .kind = StatisticKind::work}},
      {&S::directRays,
       {.name = "direct_rays",
        .label = "Rays of vertices",
        .unit = "rays",
        .meaning = "Rays for vertices with too many occluders, or for curved lights.",
        .kind = StatisticKind::work}},
      {&S::meshBytes,
       {.name = "mesh_bytes",
        .label = "Memory of meshes",
        .unit = "bytes",
        .meaning = "Memory of the vertices of the meshes of lights.",
        .budget = "mesh_memory",
        .cost = "{}"}},
      commonStatistics()};
  return table;
}

// Vertices lit in a frame with the default number of updates: about 40 ms on two cores.
constexpr float kVerticesAFrame = 2048.0f;

class MultiMesh final : public GiMethod {
 public:
  explicit MultiMesh(ManyLightsKernels& kernels) : lights_(kernels) {}

  GiOutput render(const FrameInputs& in) override {
    const MultiMeshParameters options = multiMeshParameters().read(in.settings);
    const bool onMeshes = options.direct == MultiMeshDirect::meshes;
    Settings settings = in.settings;
    settings.set("indirect", std::string("meshes"));
    lights_.leaveOutSurfaces(onMeshes);
    GiOutput out = lights_.render({in.scene, in.changes, in.view, in.backend, in.services, settings,
                                   in.frame, in.stopwatch, in.stageTimes, in.lightOnly, in.part});
    MultiMeshStats stats;
    static_cast<GiStats&>(stats) = out.stats;
    stats.take(lights_.surfaceCounts());
    stats.lightSamples = static_cast<int>(out.stats.of("vpls"));
    if (in.stopwatch) stats.stageSeconds.push_back({kDirectMeshesStage, 0.0});
    if (onMeshes)
      addDirect(in, options, out, stats);
    else
      direct_.forget();
    out.stats = published(stats, statisticTable());
    return out;
  }

  void reset() override {
    lights_.reset();
    direct_.forget();
  }
  Inspection inspect() const override { return lights_.inspect(); }

 private:
  void addDirect(const FrameInputs& in, const MultiMeshParameters& options, GiOutput& out,
                 MultiMeshStats& stats) {
    direct_.outdate(in.changes);
    if (in.part == LightPart::indirect) return;
    const double start = in.stopwatch ? in.stopwatch() : 0.0;
    const auto antialias = manyLightsParameters().read(in.settings).antialias;
    // Shifted pictures wait for the remaining light.
    const int samples = out.settled ? antialias : 1;
    const float pace = surfacePace(in.services.budget().surfaceWork, options.updates);
    out.radiance =
        direct_.addTo(in, out.radiance, samples, options.directMeshes(options.seed),
                      {in.lightOnly, options.speculars, options.leastRoughness},
                      static_cast<size_t>(std::max(1.0f, kVerticesAFrame * std::min(pace, 4.0f))),
                      lights_.gbufferIsCurrent());
    out.settled = out.settled && direct_.isDone(antialias);
    out.refined = out.refined && out.settled;
    if (!out.settled)
      stats.framesUntilSettled =
          std::max({1, stats.framesUntilSettled, direct_.framesLeft(antialias)});
    const DirectMeshes::Counts& counts = direct_.counts();
    stats.meshes = static_cast<int>(counts.meshes);
    stats.meshVertices = static_cast<int>(counts.vertices);
    stats.meshTriangles = static_cast<int>(counts.triangles);
    stats.directSamples = static_cast<int>(counts.samples);
    stats.directMasks = static_cast<int>(counts.work.masks);
    stats.directOpen = static_cast<int>(counts.work.open);
    stats.directRays = counts.work.rays;
    if (!direct_.isDone(1)) stats.surfaceWork = pace;
    stats.meshBytes = counts.bytes;
    stats.raysTraced += counts.work.rays;
    if (in.stopwatch) stats.stageSeconds.back().seconds = in.stopwatch() - start;
  }

  ManyLights lights_;
  MeshDirectLight direct_;
};

}  // namespace

MethodInfo multiMeshInfo() {
  const MethodInfo lights = manyLightsInfo();
  return {"multi_mesh",
          "Light on surfaces",
          "Multi-mesh caching: progressive rendering with irradiance at the vertices of meshes "
          "(paper 4)",
          parameterSpecs(),
          statisticTable().specs(),
          stagesOf(),
          [](Backend& backend) {
            return std::make_unique<MultiMesh>(backend.kernels<ManyLightsKernels>("multi_mesh"));
          },
          lights.needs,
          {{Capability::lights, ""},
           {Capability::patches, ""},
           {Capability::texels, ""},
           {Capability::elements, ""},
           {Capability::links, ""}}};
}

}  // namespace lamplighter
