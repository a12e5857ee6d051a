// Triangles of a mesh in groups of neighbours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter {

inline constexpr uint32_t kOccluderGroupTriangles = 16;  // at most

// The triangles of a mesh sorted along a Morton curve through their centres, and cut into groups of
// up to kOccluderGroupTriangles. A group ends early if the next triangle is more than 4 times
// larger or smaller than another one in the group, or if the group would become more than 6 times
// as large as its largest triangle (all by diagonals of bounding boxes), so large triangles have
// groups of their own.
struct OccluderOrder {
  std::vector<uint32_t> triangles;  // indices of triangles of the mesh
  std::vector<uint32_t> ends;       // by group: where it ends in `triangles`
};

// `indices`: three per triangle, into `positions` (in any space). The result depends only on the
// arguments, and is the same after scaling by a power of two.
OccluderOrder occluderOrderOf(std::span<const vec3> positions, std::span<const uint32_t> indices);

}  // namespace lamplighter
