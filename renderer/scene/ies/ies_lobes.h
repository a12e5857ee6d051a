// Approximates a profile by a few spots at one position, because VPLs support a hemisphere with a
// cone on every backend, but no table. Each lobe becomes one VPL with its own shadow map.
#pragma once

#include <functional>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter {

// intensity × clamp(cos·scale + offset, 0, 1)², cos of the angle to the axis; 0 behind it.
struct SpotLobe {
  vec3 axis{0.0f, 0.0f, -1.0f};  // unit, in the space of the light
  float intensity = 0.0f;
  float scale = 0.0f, offset = 1.0f;

  float at(const vec3& direction) const;
};

inline constexpr size_t kMostLobes = 16;

// Fits lobes to a non-negative function of direction, with the same ∫ dω. Greedy: repeatedly adds
// the lobe that contributes most, and refits all weights by non-negative least squares.
std::vector<SpotLobe> fitLobes(const std::function<float(const vec3&)>& intensity);

}  // namespace lamplighter
