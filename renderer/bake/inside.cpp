#include "renderer/bake/inside.h"

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

constexpr uint32_t kInsideRays = 16;
constexpr uint32_t kInsideSet = 0x7d;

}  // namespace

bool isInside(const RenderScene& scene, const RayCaster& rays, const ReceivingPlace& at,
              uint32_t key) {
  const Frame frame(at.normal);
  const vec3 from = at.position + rayEpsilon(at.position) * at.normal;
  uint32_t inside = 0;
  const uint32_t scramble = hash4(key, 0, 0, kInsideSet);
  for (uint32_t i = 0; i < kInsideRays; ++i) {
    const vec3 direction = frame.toWorld(sampleCosineHemisphere(sobol2(i, scramble)));
    const Hit hit = rays.intersect({from, 0.0f, direction});
    // Double-sided surfaces such as a curtain have no inside.
    if (!hit || !scene.backIsUnseen(hit.object)) continue;
    const Surface s = surfaceAt(scene, hit.object, hit.triangle, hit.u, hit.v);
    inside += glm::dot(s.geometricNormal, direction) > 0.0f;
  }
  return inside > kInsideRays / 2;
}

}  // namespace lamplighter
