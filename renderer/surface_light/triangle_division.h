// Division of a triangle at the midpoints of some of its edges. Whether an edge is divided must
// depend only on the edge: then both triangles at the edge agree, and the mesh has no T-vertices.
#pragma once

#include <array>
#include <cstdint>

#include "renderer/base/math.h"

namespace lamplighter {

// Corners 0, 1, 2; then the midpoints of the edges 0-1, 1-2 and 2-0.
inline constexpr std::array<std::array<uint8_t, 2>, 3> kEdgeCorners{{{0, 1}, {1, 2}, {2, 0}}};

struct TriangleDivision {
  int count = 0;  // number of children; 0: not divided
  std::array<std::array<uint8_t, 3>, 4> children{};
  // By child: maps barycentric coordinates of the triangle to those of the child.
  std::array<mat3, 4> toChild{};
};

// `edges`: one bit per divided edge. Three divided edges: four triangles. Two: the quadrilateral
// beside the cut corner is divided along a diagonal (`diagonal`: which one).
inline constexpr int kDivisions = 16;
constexpr int divisionOf(int edges, bool diagonal) { return edges + (diagonal ? 8 : 0); }
const TriangleDivision& triangleDivision(int division);

// The child that contains a point of the triangle, and the point in it. `weights`: barycentric
// coordinates, replaced by those in the child.
int childAt(int division, vec3& weights);

}  // namespace lamplighter
