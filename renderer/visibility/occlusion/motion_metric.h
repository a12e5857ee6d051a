// What moves mostly goes straight: the planes that it goes along stay as far from it as they are.
#pragma once

#include <cmath>

#include "renderer/base/math.h"

namespace lamplighter {

// How a distance is counted: as what is gone along the axis, and some times what is gone across it.
struct MotionMetric {
  vec3 axis{0.0f};      // unit; zero: all directions are alike
  float across = 1.0f;  // of a metre at right angles to the axis, at least one [m]

  bool operator==(const MotionMetric&) const = default;

  float lengthOf(const vec3& shift) const {
    const float along = glm::dot(shift, axis);
    return std::abs(along) + across * glm::length(shift - along * axis);
  }
  // What something comes to that goes by at most a metre whichever way.
  float most() const { return std::sqrt(glm::dot(axis, axis) + across * across); }
};

}  // namespace lamplighter
