#include "renderer/methods/path_tracer/seen_light.h"

#include <array>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/scene/light_linking.h"
#include "renderer/scene/surface.h"

namespace lamplighter {

SeenLight seenLight(const RenderScene& scene, const RayCaster& caster, const View& view, int x,
                    int y, uint32_t sample, uint32_t seed) {
  constexpr uint32_t kSeenSet = 0x5ee17;
  const uint32_t scramble = hash4(static_cast<uint32_t>(y * view.width + x), seed, 0, kSeenSet);
  std::array<Ray, kSeenRays> rays;
  std::array<Hit, kSeenRays> hits;
  for (uint32_t k = 0; k < kSeenRays; ++k) {
    const vec2 inPixel = sobol2Ordered(sample * kSeenRays + k, scramble);
    rays[k] = {
        view.eye, 0.0f,
        view.rayDirection(static_cast<float>(x) + inPixel.x, static_cast<float>(y) + inPixel.y)};
  }
  caster.intersect8(rays, hits, Surfaces::seen);
  SeenLight out;
  vec3 sum(0.0f);
  for (uint32_t k = 0; k < kSeenRays; ++k) {
    const Hit& hit = hits[k];
    if (!hit) {
      if (!isLeftOut(0, scene.skyLink)) sum += scene.sky.radianceFrom(rays[k].direction);
      continue;
    }
    if (!scene.materials[scene.objects[hit.object].material].emits()) {
      out.isMixed = true;
      continue;
    }
    const Surface s = surfaceAt(scene, hit.object, hit.triangle, hit.u, hit.v);
    if (s.emitsBothSides || glm::dot(s.geometricNormal, rays[k].direction) < 0.0f)
      sum += s.emission;
  }
  out.radiance = sum / static_cast<float>(kSeenRays);
  return out;
}

}  // namespace lamplighter
