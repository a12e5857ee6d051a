#include "renderer/imperfect_maps/solid_angle.h"

#include <cmath>

namespace lamplighter {

float signedSolidAngle(const vec3& at, const vec3& a, const vec3& b, const vec3& c) {
  const glm::dvec3 origin(at), p = glm::dvec3(a) - origin, q = glm::dvec3(b) - origin,
                               r = glm::dvec3(c) - origin;
  const glm::dvec3 normal = glm::cross(q - p, r - p);
  if (normal == glm::dvec3(0.0)) return 0.0f;
  const double lp = glm::length(p), lq = glm::length(q), lr = glm::length(r);
  const double sum = lp * lq * lr + glm::dot(p, q) * lr + glm::dot(q, r) * lp + glm::dot(r, p) * lq;
  return static_cast<float>(2.0 * std::atan2(glm::dot(p, normal), sum));
}

float solidAngle(const vec3& at, const vec3& a, const vec3& b, const vec3& c) {
  return std::abs(signedSolidAngle(at, a, b, c));
}

}  // namespace lamplighter
