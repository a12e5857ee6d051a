#include "editor/explain/light_samples.h"

#include "renderer/methods/common_parameters.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/sampling/vpl_set.h"

namespace lamplighter {
namespace {

// Enough for a penumbra to be told to a percent and for lights that give little to have some.
constexpr int kOwnSamples = 4096;
// Bounces in a corner stand for all of their surroundings; the lights themselves are only a little
// away from what they light most.
constexpr float kOwnClamp = 0.1f;  // [m]

}  // namespace

LightSamples lightSamples(const Inspection& inspection, const RenderScene& scene,
                          const RayCaster& rays, const Settings& settings) {
  LightSamples out;
  if (!inspection.lights.empty()) {
    out.clampDistance = settings.real(parameters::clampDistance());
    for (const InspectedLight& light : inspection.lights)
      if (light.isLive) out.samples.push_back({light.vpl, light.id});
    return out;
  }
  out.clampDistance = kOwnClamp;
  VplCounts counts;
  counts.total = kOwnSamples;
  counts.bounces = settings.integer(parameters::bounces());
  counts.seed = static_cast<uint32_t>(settings.integer(parameters::seed()));
  const VplSet set = generateVpls(scene, rays, LightSet(scene), counts);
  for (const SceneVpl& made : set.vpls) out.samples.push_back({made.vpl, made.id});
  return out;
}

}  // namespace lamplighter
