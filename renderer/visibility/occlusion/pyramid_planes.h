// The planes of one occlusion pyramid.
#pragma once

#include <array>

#include "renderer/base/math.h"

namespace lamplighter {

// Unit normals point inwards; inside: dot(normal, x) + offset >= 0. Eight planes are tested at
// once, so unused entries are planes that contain everything.
struct PyramidPlanes {
  static constexpr int kMost = 8;
  std::array<float, kMost> x{}, y{}, z{}, offset;

  PyramidPlanes() { offset.fill(1.0f); }

  // Whether part of the box may be inside all planes.
  bool mayMeet(const Bounds& box) const;
  // Whether the point is inside all planes by at least this much; negative: outside by at most. [m]
  bool reach(const vec3& point, float depth) const;
  // Whether part of the triangle is inside all planes. `at`: receives such a point.
  bool meet(const vec3& a, const vec3& b, const vec3& c, vec3* at = nullptr) const;
};

}  // namespace lamplighter
