#include "renderer/base/random.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {

vec2 sampleDisk(vec2 u) {
  const vec2 p = 2.0f * u - 1.0f;
  if (p.x == 0.0f && p.y == 0.0f) return p;
  float r, phi;
  if (std::abs(p.x) > std::abs(p.y)) {
    r = p.x;
    phi = 0.25f * kPi * (p.y / p.x);
  } else {
    r = p.y;
    phi = 0.5f * kPi - 0.25f * kPi * (p.x / p.y);
  }
  return r * vec2(std::cos(phi), std::sin(phi));
}

vec3 sampleCosineHemisphere(vec2 u) {
  const vec2 d = sampleDisk(u);
  return {d, std::sqrt(std::max(0.0f, 1.0f - glm::dot(d, d)))};
}

vec3 sampleSphere(vec2 u) {
  const float z = 1.0f - 2.0f * u.x;
  const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  const float phi = 2.0f * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

vec3 sampleVisibleNormal(const vec3& eye, float alpha, vec2 u) {
  const vec3 v = glm::normalize(vec3(alpha * eye.x, alpha * eye.y, eye.z));
  const float across = v.x * v.x + v.y * v.y;
  const vec3 t1 = across > 0.0f ? vec3(-v.y, v.x, 0.0f) / std::sqrt(across) : vec3(1, 0, 0);
  const vec3 t2 = glm::cross(v, t1);
  const float r = std::sqrt(u.x), phi = 2.0f * kPi * u.y;
  const float x = r * std::cos(phi);
  const float s = 0.5f * (1.0f + v.z);
  const float y = (1.0f - s) * std::sqrt(1.0f - x * x) + s * r * std::sin(phi);
  const vec3 n = x * t1 + y * t2 + std::sqrt(std::max(0.0f, 1.0f - x * x - y * y)) * v;
  return glm::normalize(vec3(alpha * n.x, alpha * n.y, std::max(1e-6f, n.z)));
}

}  // namespace lamplighter
