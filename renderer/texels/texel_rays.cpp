#include "renderer/texels/texel_rays.h"

namespace lamplighter {

bool blocksBouncedLight(const RenderScene& scene, const RayCaster& rays, Ray ray) {
  for (Hit hit = rays.intersect(ray); hit; hit = rays.intersect(ray)) {
    if (!scene.objects[hit.object].isAreaLight) return true;
    ray.tNear = hit.t + rayEpsilon(ray.origin + hit.t * ray.direction) / glm::length(ray.direction);
  }
  return false;
}

bool seesByRay(const RenderScene& scene, const RayCaster& rays, const SurfaceTexel& texel,
               const vec3& point) {
  const vec3 from = texel.spot.rayOrigin(), d = point - from;
  if (glm::dot(d, texel.spot.geometricNormal) <= 0.0f) return false;
  return !blocksBouncedLight(scene, rays, {from, 0.0f, d, 1.0f - 1e-3f});
}

}  // namespace lamplighter
