#include "renderer/methods/ambient_occlusion/accessibility.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"

namespace lamplighter {

float sampleAccessibility(const RayCaster& rays, const vec3& position, const vec3& normal,
                          const vec3& geometricNormal, uint32_t pixel, uint32_t sample,
                          const AccessibilityOptions& options) {
  const vec2 u = sobol2(sample, hash4(pixel, static_cast<uint32_t>(options.seed), 0xa0u, 0u));
  vec3 direction = Frame(normal).toWorld(sampleCosineHemisphere(u));
  const float below = std::min(glm::dot(direction, geometricNormal), 0.0f);
  direction -= 2.0f * below * geometricNormal;
  const Ray ray{position + rayEpsilon(position) * geometricNormal, 0.0f, direction, options.radius};
  if (options.falloff == Falloff::none) return rays.occluded(ray) ? 0.0f : 1.0f;
  const Hit hit = rays.intersect(ray);
  if (!hit) return 1.0f;
  const float share = hit.t / options.radius;
  return options.falloff == Falloff::linear ? share : std::sqrt(share);
}

}  // namespace lamplighter
