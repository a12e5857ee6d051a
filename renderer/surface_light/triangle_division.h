// How a triangle is divided at the midpoints of some of its edges. Whether an edge is divided must
// depend on the edge alone: then both triangles at an edge divide it alike, and the mesh has no
// T-vertices.
#pragma once

#include <array>
#include <cstdint>

#include "renderer/base/math.h"

namespace lamplighter {

// Corners 0, 1, 2; then the midpoints of the edges 0-1, 1-2 and 2-0.
inline constexpr std::array<std::array<uint8_t, 2>, 3> kEdgeCorners{{{0, 1}, {1, 2}, {2, 0}}};

struct TriangleDivision {
  int count = 0;  // of children; 0: not divided
  std::array<std::array<uint8_t, 3>, 4> children{};
  // By child: from barycentric coordinates of the triangle to those of the child.
  std::array<mat3, 4> toChild{};
};

// `edges`: one bit per divided edge. With three, the triangle is quartered; with two, the rest
// beside the cut corner is divided along one of its diagonals (`diagonal`: which).
inline constexpr int kDivisions = 16;
constexpr int divisionOf(int edges, bool diagonal) { return edges + (diagonal ? 8 : 0); }
const TriangleDivision& triangleDivision(int division);

// The child that contains a point of the triangle, and the point in it. `weights`: barycentric
// coordinates, replaced by those in the child.
int childAt(int division, vec3& weights);

}  // namespace lamplighter
