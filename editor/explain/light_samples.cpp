#include "editor/explain/light_samples.h"

#include <algorithm>

#include "renderer/methods/many_lights/parameters.h"
#include "renderer/sampling/vpl_set.h"

namespace lamplighter {
namespace {

// Enough to measure a penumbra to one percent, and to give weak lights some samples.
constexpr int kOwnSamples = 4096;
// In a corner, a bounce sample represents all of its surroundings, so its value needs a bound. The
// distance is small, because lights can be close to the surfaces that they light most.
constexpr float kOwnClamp = 0.1f;  // [unit of the scene]

// Many samples, of all bounces.
VplSet ownSamples(const RenderScene& scene, const RayCaster& rays, const Settings& settings) {
  VplCounts counts;
  counts.total = kOwnSamples;
  const PathParameters paths = pathParameters().read(settings);
  counts.bounces = paths.bounces;
  counts.seed = static_cast<uint32_t>(paths.seed);
  return generateVpls(scene, rays, LightSet(scene), counts);
}

// Whether an emitter of this kind sends light, apart from the suns of the sky.
bool hasLightOf(const RenderScene& scene, EmitterKind kind) {
  return std::ranges::any_of(LightSet(scene).emitters(), [&](const Emitter& e) {
    return e.kind == kind && e.skySun == 0 && luminance(e.flux) > 0.0f;
  });
}

}  // namespace

LightSamples lightSamples(const Inspection& inspection, const RenderScene& scene,
                          const RayCaster& rays, const Settings& settings) {
  LightSamples out;
  out.unit = scene.unit;
  out.clampDistance =
      inspection.lights.empty() ? kOwnClamp : manyLightsParameters().read(settings).clampDistance;
  for (const LightSample& light : inspection.lights)
    if (light.isLive) out.samples.push_back({light.vpl, light.id});
  const bool lackAll = inspection.lights.empty();
  const bool lackBounced = std::ranges::none_of(
      inspection.lights, [](const LightSample& light) { return light.id.bounce > 0; });
  const bool lackSky = inspection.lightsLeaveOutSky && hasLightOf(scene, EmitterKind::sky);
  const bool lackSurfaces =
      inspection.lightsLeaveOutSurfaces && hasLightOf(scene, EmitterKind::surface);
  const int bounces = pathParameters().read(settings).bounces;
  if (!lackAll && !lackSky && !lackSurfaces && (!lackBounced || bounces == 0)) return out;
  for (const SceneVpl& made : ownSamples(scene, rays, settings).vpls) {
    const bool lacksDirect = made.isSample && (made.id.light == kNoNode ? lackSky : lackSurfaces);
    if (lackAll || (made.id.bounce > 0 ? lackBounced : lacksDirect))
      out.samples.push_back({made.vpl, made.id});
  }
  return out;
}

}  // namespace lamplighter
