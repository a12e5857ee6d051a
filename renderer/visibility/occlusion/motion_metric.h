// A metric for straight motion. Planes parallel to the motion keep their distance from the mover,
// so motion along the axis counts less than motion across it.
#pragma once

#include <cmath>

#include "renderer/base/math.h"

namespace lamplighter {

// Length = the part along the axis + `across` × the part perpendicular to the axis.
struct MotionMetric {
  vec3 axis{0.0f};      // unit; zero: all directions count the same
  float across = 1.0f;  // weight of a metre perpendicular to the axis, ≥ 1 [m]

  bool operator==(const MotionMetric&) const = default;

  float lengthOf(const vec3& shift) const {
    const float along = glm::dot(shift, axis);
    return std::abs(along) + across * glm::length(shift - along * axis);
  }
  // Upper bound of the metric for a motion of one metre in any direction.
  float most() const { return std::sqrt(glm::dot(axis, axis) + across * across); }
};

}  // namespace lamplighter
