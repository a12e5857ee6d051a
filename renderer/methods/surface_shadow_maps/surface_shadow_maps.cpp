#include "renderer/methods/surface_shadow_maps/surface_shadow_maps.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "renderer/base/random.h"
#include "renderer/methods/common_statistics.h"
#include "renderer/methods/many_lights/many_lights.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/methods/many_lights/stages.h"
#include "renderer/methods/surface_shadow_maps/atlas_picture.h"
#include "renderer/methods/surface_shadow_maps/parameters.h"

namespace lamplighter {
namespace {

constexpr StageSpec kRadiosityStage{
    "radiosity", "Radiosity",
    "Depths and links of texels, their bounced light, and showing it at pixels."};

// Those of many_lights, and the last.
std::span<const StageSpec> stagesOf() {
  static const std::vector<StageSpec> stages = [] {
    std::vector<StageSpec> all(std::begin(kManyLightsStages), std::end(kManyLightsStages));
    all.push_back(kRadiosityStage);
    return all;
  }();
  return stages;
}

// Direct light is that of many_lights, whose parameters have the same names.
std::vector<ParameterSpec> parameterSpecs() {
  static const ParameterTable<ManyLightsParameters> direct{
      manyLightsParameters().only("vpls"), manyLightsParameters().only("antialias"),
      manyLightsParameters().only("share_memory"), manyLightsParameters().only("refine")};
  std::vector<ParameterSpec> specs = surfaceShadowMapsParameters().specs();
  specs.insert(specs.end(), direct.specs().begin(), direct.specs().end());
  return specs;
}

struct Stats : GiStats {
  int lightSamples = 0, texels = 0, links = 0, segments = 0;
  float texelSide = 0.0f, ratio = 0.0f, progress = 0.0f;
  uint64_t texelRays = 0, bytes = 0;
};

const StatisticTable<Stats>& statisticTable() {
  using S = Stats;
  static const StatisticTable<S> table{
      {&S::lightSamples,
       {.name = "light_samples",
        .label = "Light samples",
        .unit = "samples",
        .meaning = "Light samples on the lights, for direct light at pixels."}},
      {&S::texels,
       {.name = "surface_texels",
        .label = "Texels",
        .unit = "texels",
        .meaning = "Texels of surface that keep bounced light."}},
      {&S::texelSide,
       {.name = "texel_side",
        .label = "Side of texels",
        .unit = "m",
        .meaning = "Side of the texels that memory allows.",
        .budget = "depth_memory",
        .cost = "texels of {}"}},
      {&S::segments,
       {.name = "depth_segments",
        .label = "Segments of depths",
        .unit = "segments",
        .meaning = "Segments of equal depths of consecutive texels."}},
      {&S::ratio,
       {.name = "depth_ratio",
        .label = "Pixels a segment",
        .unit = "pixels",
        .meaning = "Pixels of depth maps for which a segment stands: how well depths are "
                   "compressed."}},
      {&S::links,
       {.name = "links",
        .label = "Links",
        .unit = "links",
        .meaning = "Links by which texels receive light from surfaces."}},
      {&S::texelRays,
       {.name = "texel_rays",
        .label = "Rays of texels",
        .unit = "rays",
        .meaning = "Rays for depths and for the direct light of texels that were traced in this "
                   "frame.",
        .kind = StatisticKind::work}},
      {&S::progress,
       {.name = "prepared",
        .label = "Prepared",
        .unit = "%",
        .meaning = "Share of the depths and links that is found."}},
      {&S::bytes,
       {.name = "depth_bytes",
        .label = "Memory of depths and links",
        .unit = "bytes",
        .meaning = "Memory of depths, links and direct light of texels.",
        .budget = "depth_memory",
        .cost = "{}"}},
      commonStatistics()};
  return table;
}

// Rays of a frame with the default number of updates: some 50 ms on two cores.
constexpr float kRaysAFrame = 300'000.0f;

class SurfaceShadowMaps final : public GiMethod {
 public:
  explicit SurfaceShadowMaps(ManyLightsKernels& kernels) : lights_(kernels) {}

  GiOutput render(const FrameInputs& in) override {
    const SurfaceShadowMapsParameters options = surfaceShadowMapsParameters().read(in.settings);
    Settings settings = in.settings;
    settings.set("bounces", 0);
    settings.set("indirect", std::string("samples"));
    GiOutput out = lights_.render({in.scene, in.changes, in.view, in.backend, in.services, settings,
                                   in.frame, in.stopwatch, in.stageTimes, in.lightOnly, in.part});
    Stats stats;
    static_cast<GiStats&>(stats) = out.stats;
    stats.lightSamples = static_cast<int>(out.stats.of("vpls"));
    const double start = in.stopwatch ? in.stopwatch() : 0.0;
    radiosity_.outdate(in.changes);
    picture_.outdate(in.changes);
    if (options.bounces == 0) {
      radiosity_.forget();
      picture_.forget();
    } else if (in.part != LightPart::direct) {
      addBounced(in, options, out, stats);
    }
    if (in.stopwatch) stats.stageSeconds.push_back({kRadiosityStage, in.stopwatch() - start});
    out.stats = published(stats, statisticTable());
    return out;
  }

  void reset() override {
    lights_.reset();
    radiosity_.forget();
    picture_.forget();
  }

  Inspection inspect() const override {
    Inspection out = lights_.inspect();
    out.patches = nullptr;
    out.texels = nullptr;
    out.elements = nullptr;
    out.pictures["atlas_texels"] = [this] {
      return draw({}, [](uint32_t t) {
        return static_cast<float>(hash4(t, 0, 0, 0x7e) % 1000u) / 1000.0f;
      });
    };
    out.pictures["texel_links"] = [this] {
      return draw({"Links of a texel", 1000.0f}, [this](uint32_t t) {
        return radiosity_.links().isDone()
                   ? static_cast<float>(radiosity_.links().of(t).size()) / 1000.0f
                   : 0.0f;
      });
    };
    return out;
  }

 private:
  void addBounced(const FrameInputs& in, const SurfaceShadowMapsParameters& options, GiOutput& out,
                  Stats& stats) {
    const float pace =
        static_cast<float>(options.updates) / static_cast<float>(FrameBudgetParameters().updates);
    radiosity_.update(in.scene, in.services, options.radiosity(),
                      static_cast<uint64_t>(kRaysAFrame * std::min(pace, 8.0f)) + 1);
    // Shifted pictures wait for the rest of the light.
    const int antialias = out.settled ? manyLightsParameters().read(in.settings).antialias : 1;
    out.radiance = picture_.addTo(in, out.radiance, radiosity_, antialias,
                                  {in.lightOnly, options.speculars, options.leastRoughness},
                                  lights_.gbufferIsCurrent());
    const bool isDone = radiosity_.isDone() && picture_.isDone(antialias);
    if (!isDone)
      stats.framesUntilSettled =
          std::max({1, stats.framesUntilSettled,
                    radiosity_.isDone() ? picture_.framesLeft(antialias) : antialias + 1});
    out.settled = out.settled && isDone;
    out.refined = out.refined && out.settled;
    const SurfaceDepths& depths = radiosity_.depths();
    stats.texelRays = radiosity_.counts().rays;
    stats.raysTraced += stats.texelRays;
    stats.texels = static_cast<int>(radiosity_.texels().size());
    stats.texelSide = radiosity_.counts().texel;
    stats.links = static_cast<int>(radiosity_.links().size());
    stats.segments = static_cast<int>(depths.segments());
    if (stats.segments > 0)
      stats.ratio = static_cast<float>(depths.uncompressed()) / static_cast<float>(stats.segments);
    stats.progress = 100.0f * radiosity_.progress();
    stats.bytes = radiosity_.counts().bytes;
  }

  struct Scale {
    std::string title = "Texels";
    float high = 0.0f;
  };
  // Each texel by a number from 0 to 1.
  template <typename Number>
  ViewPicture draw(const Scale& scale, const Number& numberOf) const {
    ViewPicture out;
    const View& view = picture_.view();
    out.image = Image8(view.width, view.height);
    const std::vector<uint32_t> texels = picture_.texels();
    for (size_t i = 0; i < texels.size(); ++i)
      if (texels[i] != TexelSet::kNone)
        std::fill_n(&out.image.pixels[4 * i], 3,
                    static_cast<uint8_t>(255.0f * std::clamp(numberOf(texels[i]), 0.0f, 1.0f)));
    out.legend.title = scale.title;
    if (scale.high > 0.0f) {
      out.legend.ramp = {vec3(0.0f), vec3(1.0f)};
      out.legend.low = "0";
      out.legend.high = std::to_string(static_cast<int>(scale.high));
    }
    return out;
  }

  ManyLights lights_;
  TexelRadiosity radiosity_;
  AtlasPicture picture_;
};

}  // namespace

MethodInfo surfaceShadowMapsInfo() {
  const MethodInfo lights = manyLightsInfo();
  MethodNeeds needs = lights.needs;
  if (std::ranges::find(needs.services, Service::charts) == needs.services.end())
    needs.services.push_back(Service::charts);
  if (std::ranges::find(needs.services, Service::rays) == needs.services.end())
    needs.services.push_back(Service::rays);
  return {"surface_shadow_maps",
          "Surface shadow maps",
          "T. Ritschel, T. Grosch, J. Kautz, S. Mueller: Interactive global illumination based on "
          "coherent surface shadow maps. Graphics Interface 2008 (paper 3).",
          parameterSpecs(),
          statisticTable().specs(),
          stagesOf(),
          [](Backend& backend) {
            return std::make_unique<SurfaceShadowMaps>(
                backend.kernels<ManyLightsKernels>("surface_shadow_maps"));
          },
          std::move(needs),
          {{Capability::lights, ""}},
          {{"atlas_texels", "Texels of the atlas",
            "The texels that keep bounced light, each in another shade."},
           {"texel_links", "Links of texels",
            "The number of links by which each texel receives light."}}};
}

}  // namespace lamplighter
