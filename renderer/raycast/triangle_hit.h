// Intersection of a ray with a triangle that it is known to hit, in plain IEEE arithmetic. Embree's
// own distances and barycentrics use approximate reciprocals, which differ between processors.
#pragma once

#include <algorithm>

#include "renderer/base/math.h"

namespace lamplighter {

struct TriangleHit {
  float t;     // distance in units of |direction|
  float u, v;  // weights of the second and third vertex; u, v and 1 − u − v are ≥ 0
};

// Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997, without the tests.
// Barycentrics outside the triangle due to rounding are clamped to its edge, and t is clamped to
// [tNear, tFar]. A ray in the plane of the triangle has no unique hit; it gets tNear and the first
// corner.
inline TriangleHit triangleHit(const vec3& origin, const vec3& direction, float tNear, float tFar,
                               const vec3& a, const vec3& b, const vec3& c) {
  const vec3 ab = b - a, ac = c - a, oa = a - origin;
  const vec3 normal = glm::cross(ab, ac), side = glm::cross(oa, direction);
  const float along = glm::dot(direction, normal);
  if (along == 0.0f) return {tNear, 0.0f, 0.0f};
  const float inverse = 1.0f / along;
  const float u = std::clamp(glm::dot(side, ac) * inverse, 0.0f, 1.0f);
  const float v = std::clamp(-glm::dot(side, ab) * inverse, 0.0f, 1.0f - u);
  return {std::clamp(glm::dot(oa, normal) * inverse, tNear, tFar), u, v};
}

}  // namespace lamplighter
