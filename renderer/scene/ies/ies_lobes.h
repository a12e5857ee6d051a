// A profile as a few spots at one place: virtual point lights know a hemisphere with a cone, on
// every backend, and no table. Each lobe is one of them, with a shadow map of its own.
#pragma once

#include <functional>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter {

// intensity × clamp(cos·scale + offset, 0, 1)² about the axis, cos from the axis; none behind it.
struct SpotLobe {
  vec3 axis{0.0f, 0.0f, -1.0f};  // unit, in the light's space
  float intensity = 0.0f;
  float scale = 0.0f, offset = 1.0f;

  float at(const vec3& direction) const;
};

inline constexpr size_t kMostLobes = 16;

// Lobes whose sum is near the function of direction, which is 0 or above, and has its ∫ dω: those
// that bring most, one after the other, all weighed anew by non-negative least squares each time.
std::vector<SpotLobe> fitLobes(const std::function<float(const vec3&)>& intensity);

}  // namespace lamplighter
