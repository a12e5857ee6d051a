// The charts of a mesh with a place for each in one rectangle of texels: a layout that all
// instances of the mesh can share. A method that stores values on surfaces gives each object such a
// rectangle.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/atlas/placed_chart.h"

namespace lamplighter {

struct MeshAtlas {
  std::vector<PlacedChart> charts;   // in the space of the mesh
  std::vector<int> chartOfTriangle;  // kNone: the triangle has no area
  glm::ivec2 size{0};                // of the rectangle [texels]

  // Projects a point of a triangle to the rectangle [texels].
  vec2 texelsOf(uint32_t triangle, const vec3& p) const {
    return charts[static_cast<size_t>(chartOfTriangle[triangle])].texelsOf(p);
  }
};

// As unwrap(); the rectangle is nearly square, and filled by the skyline heuristic.
MeshAtlas makeMeshAtlas(std::span<const vec3> positions, std::span<const uint32_t> indices,
                        float texelsPerMetre);

// For files.
std::vector<uint8_t> bytesOf(const MeshAtlas& atlas);
// Returns none if the bytes are not an atlas of a mesh with `triangles` triangles.
std::optional<MeshAtlas> meshAtlasOf(std::span<const uint8_t> bytes, size_t triangles);

}  // namespace lamplighter
