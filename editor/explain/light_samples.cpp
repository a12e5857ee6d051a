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

}  // namespace

LightSamples lightSamples(const Inspection& inspection, const RenderScene& scene,
                          const RayCaster& rays, const Settings& settings) {
  LightSamples out;
  out.unit = scene.unit;
  out.clampDistance =
      inspection.lights.empty() ? kOwnClamp : manyLightsParameters().read(settings).clampDistance;
  for (const LightSample& light : inspection.lights)
    if (light.isLive) out.samples.push_back({light.vpl, light.id});
  const bool haveBounced = std::ranges::any_of(
      inspection.lights, [](const LightSample& light) { return light.id.bounce > 0; });
  if (haveBounced || (!inspection.lights.empty() && pathParameters().read(settings).bounces == 0))
    return out;
  for (const SceneVpl& made : ownSamples(scene, rays, settings).vpls)
    if (inspection.lights.empty() || made.id.bounce > 0) out.samples.push_back({made.vpl, made.id});
  return out;
}

}  // namespace lamplighter
