#include "editor/explain/light_samples.h"

#include "renderer/methods/many_lights/parameters.h"
#include "renderer/sampling/vpl_set.h"

namespace lamplighter {
namespace {

// Enough to measure a penumbra to one percent, and to give weak lights some samples.
constexpr int kOwnSamples = 4096;
// In a corner, a bounce sample represents all of its surroundings, so its value needs a bound. The
// distance is small, because lights can be close to the surfaces that they light most.
constexpr float kOwnClamp = 0.1f;  // [unit of the scene]

}  // namespace

LightSamples lightSamples(const Inspection& inspection, const RenderScene& scene,
                          const RayCaster& rays, const Settings& settings) {
  LightSamples out;
  out.unit = scene.unit;
  if (!inspection.lights.empty()) {
    out.clampDistance = manyLightsParameters().read(settings).clampDistance;
    for (const LightSample& light : inspection.lights)
      if (light.isLive) out.samples.push_back({light.vpl, light.id});
    return out;
  }
  out.clampDistance = kOwnClamp;
  VplCounts counts;
  counts.total = kOwnSamples;
  const PathParameters paths = pathParameters().read(settings);
  counts.bounces = paths.bounces;
  counts.seed = static_cast<uint32_t>(paths.seed);
  const VplSet set = generateVpls(scene, rays, LightSet(scene), counts);
  for (const SceneVpl& made : set.vpls) out.samples.push_back({made.vpl, made.id});
  return out;
}

}  // namespace lamplighter
