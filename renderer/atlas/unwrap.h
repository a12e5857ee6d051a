// Segments a mesh into charts and projects each chart onto a plane (the
// segmentation and parametrisation step of Lévy et al., "Least Squares Conformal Maps for Automatic
// Texture Atlas Generation", SIGGRAPH 2002, but with a projection instead of the conformal map:
// charts bend by at most kMostBend, so the distortion is small).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter {

// Connected triangles that do not overlap when projected onto the chart's plane.
struct MeshChart {
  std::vector<uint32_t> triangles;                             // within the mesh, ascending
  vec3 tangent{1, 0, 0}, bitangent{0, 1, 0}, normal{0, 0, 1};  // unit, right-handed
  vec2 min{0.0f}, max{0.0f};  // bounds along tangent and bitangent [m]

  vec2 project(const vec3& p) const { return {glm::dot(p, tangent), glm::dot(p, bitangent)}; }
  vec2 extent() const { return max - min; }
};

// Largest angle between a triangle and the plane of its chart. Projected lengths across the bend
// are at least 0.77 of the true lengths.
inline constexpr float kMostBend = 40.0f * kPi / 180.0f;

// Puts each triangle with non-zero area into exactly one chart. Overlaps are found on a grid with
// `cellsPerMetre` cells per metre. `indices` refer to `positions`, three per triangle. The charts
// are in the space of the positions, in which a unit is a metre. Deterministic.
std::vector<MeshChart> unwrap(std::span<const vec3> positions, std::span<const uint32_t> indices,
                              float cellsPerMetre);

}  // namespace lamplighter
