#include "renderer/backends/cpu/shadow_maps/shadow_maps.h"

#include <algorithm>
#include <array>

#include "shaders/shared/octahedral.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter::cpu {
namespace {

// The ray of a hemisphere map's texel. Its direction has w = 1, so t equals w at the hit.
Ray hemisphereRay(const shared::Vpl& vpl, const mat3& frame, float tNear, vec2 centre) {
  return {vec3(vpl.position), tNear, frame * shared::octahedralDecode(centre)};
}

// The ray of an orthographic map's texel; it starts on the light's side outside the scene.
Ray directionalRay(const shared::Vpl& vpl, const mat3& frame, vec2 centre) {
  const float radius = vpl.normal.w, side = vpl.tangent.w;
  return {vec3(vpl.position) + frame * vec3(side * centre, radius), 0.0f, -frame[2], 2.0f * radius};
}

}  // namespace

uint64_t traceShadowMap(const RayCaster& rays, const shared::Vpl& vpl, int resolution, int firstRow,
                        int lastRow, std::span<float> map, std::span<const uint8_t> wanted) {
  const bool directional = vpl.position.w == shared::kVplDirectional;
  const vec3 normal(vpl.normal), tangent(vpl.tangent);
  const mat3 frame(tangent, glm::cross(normal, tangent), normal);
  const float tNear = rayEpsilon(vec3(vpl.position));
  const float size = static_cast<float>(resolution);
  uint64_t count = 0;
  size_t block = 0;
  for (int y0 = firstRow; y0 < lastRow; y0 += kBlockHeight) {
    for (int x0 = 0; x0 < resolution; x0 += kBlockWidth, ++block) {
      if (!wanted.empty() && wanted[block] == 0) continue;
      std::array<Ray, kLanes> ray;
      std::array<float, kLanes> distance;
      for (int lane = 0; lane < kLanes; ++lane) {
        const int x = x0 + lane % kBlockWidth, y = y0 + lane / kBlockWidth;
        const vec2 centre = shared::shadowTexelCentre(vec2(x, y), size);
        ray[lane] = directional ? directionalRay(vpl, frame, centre)
                                : hemisphereRay(vpl, frame, tNear, centre);
        if (x >= resolution || y >= lastRow) ray[lane].tFar = -1.0f;
      }
      rays.distance8(ray, distance);
      for (int lane = 0; lane < kLanes; ++lane) {
        const int x = x0 + lane % kBlockWidth, y = y0 + lane / kBlockWidth;
        if (x >= resolution || y >= lastRow) continue;
        // A miss has an infinite distance and stores 0.
        const float t = distance[lane];
        map[static_cast<size_t>(y) * resolution + x] =
            directional ? std::max(0.0f, 1.0f - t / (2.0f * vpl.normal.w)) : 1.0f / t;
        ++count;
      }
    }
  }
  return count;
}

}  // namespace lamplighter::cpu
