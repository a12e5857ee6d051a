// Cuts an object into charts that lie flat on a plane each, so that light maps have a place on it
// (the segmentation and parametrisation step of Lévy et al., "Least Squares Conformal Maps for
// Automatic Texture Atlas Generation", SIGGRAPH 2002, with a projection in the place of the
// conformal map: charts bend by no more than kMostBend, so that it stretches little).
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Connected triangles that do not overlap in their plane.
struct BakeChart {
  uint32_t object = 0;                                         // index into RenderScene::objects
  std::vector<uint32_t> triangles;                             // within the object, ascending
  vec3 tangent{1, 0, 0}, bitangent{0, 1, 0}, normal{0, 0, 1};  // unit, right-handed, world space
  vec2 min{0.0f}, max{0.0f};  // what it covers along tangent and bitangent [m]

  vec2 project(const vec3& p) const { return {glm::dot(p, tangent), glm::dot(p, bitangent)}; }
  vec2 extent() const { return max - min; }
};

// Triangles are turned from their chart's plane by no more than this: lengths across the bend are
// at least 0.77 of what they are in space.
inline constexpr float kMostBend = 40.0f * kPi / 180.0f;

// Every triangle of the object that has an area is in one chart. Overlaps are looked for on a grid
// of so many cells a metre. Deterministic.
std::vector<BakeChart> unwrap(const RenderScene& scene, uint32_t object, float cellsPerMetre);

}  // namespace lamplighter
