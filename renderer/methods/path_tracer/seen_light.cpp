#include "renderer/methods/path_tracer/seen_light.h"

#include <algorithm>
#include <array>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/methods/path_tracer/light_samples.h"
#include "renderer/scene/surface.h"

namespace lamplighter {

SeenLight seenLight(const RenderScene& scene, const RayCaster& caster, const LightSet& lights,
                    const View& view, int x, int y, uint32_t sample, uint32_t seed) {
  constexpr uint32_t kSeenSet = 0x5ee17;
  const uint32_t scramble = hash4(static_cast<uint32_t>(y * view.width + x), seed, 0, kSeenSet);
  std::array<vec2, kSeenRays> inPixel;
  std::array<Ray, kSeenRays> rays;
  std::array<Hit, kSeenRays> hits;
  for (uint32_t k = 0; k < kSeenRays; ++k) {
    inPixel[k] = sobol2Ordered(sample * kSeenRays + k, scramble);
    rays[k] = {view.eye, 0.0f,
               view.rayDirection(static_cast<float>(x) + inPixel[k].x,
                                 static_cast<float>(y) + inPixel[k].y)};
  }
  caster.intersect8(rays, hits, Surfaces::seen);
  const LightSamples samples(scene, caster, lights);
  SeenLight out;
  std::array<uint32_t, kSeenRays> onSurfaces{};
  uint32_t count = 0;
  for (uint32_t k = 0; k < kSeenRays; ++k) {
    const Hit& hit = hits[k];
    if (!hit) {
      out.radiance += samples.skySeen(rays[k].direction, 0.0f);
      continue;
    }
    onSurfaces[count++] = k;
    const Surface surface = surfaceAt(scene, hit.object, hit.triangle, hit.u, hit.v);
    const vec3 emission = samples.emissionSeen(hit, surface, rays[k].direction, view.eye, 0.0f);
    out.radiance += emission;
    out.isMixed = out.isMixed || emission == vec3(0.0f);
  }
  constexpr float kShare = 1.0f / static_cast<float>(kSeenRays);
  out.radiance *= kShare;
  if (count == 0) return out;
  out.surfaces = kShare * static_cast<float>(count);
  const float choice = toUnitFloat(hash4(scramble, sample, 1, kSeenSet));
  const auto chosen = static_cast<uint32_t>(choice * static_cast<float>(count));
  out.onSurface = inPixel[onSurfaces[std::min(chosen, count - 1)]];
  return out;
}

}  // namespace lamplighter
