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

}  // namespace lamplighter
