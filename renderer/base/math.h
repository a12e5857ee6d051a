// Vector types of all layers, and axis-aligned bounds. Right-handed, Y up, metres.
#pragma once

#include <cmath>
#include <limits>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace lamplighter {

using glm::mat3;
using glm::mat4;
using glm::quat;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr float kPi = 3.14159265358979323846f;

// Luminance of a linear colour with Rec. 709 primaries.
inline float luminance(const vec3& c) { return glm::dot(c, vec3(0.2126f, 0.7152f, 0.0722f)); }

// An axis-aligned box; empty (min > max) until a point is added.
struct Bounds {
  vec3 min{std::numeric_limits<float>::infinity()};
  vec3 max{-std::numeric_limits<float>::infinity()};

  bool empty() const { return min.x > max.x; }
  void add(const vec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void add(const Bounds& b) {
    min = glm::min(min, b.min);
    max = glm::max(max, b.max);
  }
  vec3 centre() const { return empty() ? vec3(0.0f) : 0.5f * (min + max); }
  vec3 extent() const { return empty() ? vec3(0.0f) : max - min; }
  float radius() const { return 0.5f * glm::length(extent()); }
};

// Two unit vectors that make a right-handed frame (tangent, bitangent, normal) with the unit vector
// `normal`: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
struct Frame {
  vec3 tangent, bitangent, normal;

  explicit Frame(const vec3& n) : normal(n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    tangent = vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    bitangent = vec3(b, sign + n.y * n.y * a, -n.y);
  }
  vec3 toWorld(const vec3& v) const { return v.x * tangent + v.y * bitangent + v.z * normal; }
  vec3 toLocal(const vec3& v) const {
    return {glm::dot(v, tangent), glm::dot(v, bitangent), glm::dot(v, normal)};
  }
};

}  // namespace lamplighter
