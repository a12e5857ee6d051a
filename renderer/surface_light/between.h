// Conservative test: may an object block the line between two others?
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "renderer/base/math.h"

namespace lamplighter {

// A sphere around a box, a point, or other spheres.
struct Ball {
  vec3 centre;
  float radius;
  explicit Ball(const Bounds& box) : centre(box.centre()), radius(box.radius()) {}
  explicit Ball(const vec3& point) : centre(point), radius(0.0f) {}
  explicit Ball(std::span<const Ball> balls) : centre(0.0f), radius(0.0f) {
    Bounds bounds;
    for (const Ball& b : balls) {
      bounds.add(b.centre - b.radius);
      bounds.add(b.centre + b.radius);
    }
    if (bounds.empty()) return;
    centre = bounds.centre();
    for (const Ball& b : balls)
      radius = std::max(radius, glm::distance(centre, b.centre) + b.radius);
  }
};

// Whether the convex hull of two spheres may touch a third one. Conservative.
inline bool mayBeBetween(const Ball& a, const Ball& b, const Ball& between) {
  const vec3 axis = b.centre - a.centre;
  const float length2 = glm::dot(axis, axis);
  const float t = length2 > 0.0f
                      ? std::clamp(glm::dot(between.centre - a.centre, axis) / length2, 0.0f, 1.0f)
                      : 0.0f;
  // The hull is a cone between the spheres, whose radius grows with this slope along the axis.
  const float length = std::sqrt(length2);
  const float slope = length > 0.0f ? (b.radius - a.radius) / length : 0.0f;
  float thickest = std::max(a.radius, b.radius) + between.radius;
  if (std::abs(slope) < 0.9f)
    thickest = (a.radius + between.radius + slope * t * length) / std::sqrt(1.0f - slope * slope);
  const float radius = 1.001f * thickest;
  const vec3 d = between.centre - (a.centre + t * axis);
  return glm::dot(d, d) <= radius * radius;
}

}  // namespace lamplighter
