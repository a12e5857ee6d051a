// Helpers for VPLs.
#pragma once

#include <algorithm>
#include <cstdint>

#include "renderer/base/math.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// Whether the slot contains a VPL; empty slots have a zero normal.
inline bool isLight(const shared::Vpl& vpl) { return vec3(vpl.normal) != vec3(0.0f); }

// The largest channel of the intensity.
inline float brightness(const shared::Vpl& vpl) {
  return std::max({vpl.intensity.r, vpl.intensity.g, vpl.intensity.b});
}

// The side of a cube, 0 to 5, to which the direction points.
inline uint64_t sideOf(const vec3& n) {
  const vec3 a = glm::abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return static_cast<uint64_t>(2 * axis + (n[axis] < 0.0f ? 1 : 0));
}

}  // namespace lamplighter
