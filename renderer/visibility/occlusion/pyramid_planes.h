// The planes of one occlusion pyramid.
#pragma once

#include <array>

#include "renderer/base/math.h"

namespace lamplighter {

// Unit normals inwards; inside: dot(normal, x) + offset >= 0. Eight at a time are tested, so that
// what follows the last are planes that everything is inside of.
struct PyramidPlanes {
  static constexpr int kMost = 8;
  std::array<float, kMost> x{}, y{}, z{}, offset;

  PyramidPlanes() { offset.fill(1.0f); }

  // Whether any of a triangle is inside of all. `at`: a point of what is, if so.
  bool meet(const vec3& a, const vec3& b, const vec3& c, vec3* at = nullptr) const;
};

}  // namespace lamplighter
