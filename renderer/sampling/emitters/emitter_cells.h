// Where a surface is bright whose emission varies by a texture or an alpha mask: its triangles are
// cut into cells, and points are drawn from these by the flux that each gives.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

// How bright the cells of an object are over its emissive factor: mesh, texture and mask alone, so
// that it outlives every edit of place, size and strength. A triangle is cut in four at the middles
// of its sides, each part again, up to its level; its cells stand in that order, so that near ones
// are near in the list.
struct CellBrightness {
  // All that it depends on: two of the same key are the same.
  struct Key {
    Key(const RenderScene& scene, uint32_t object);
    bool operator==(const Key&) const = default;

    uint64_t content = 0;
    std::shared_ptr<const Image8> emission, mask;  // kept, so that no other takes their address
  };

  // By the mean of 4 or 16 points of each cell, the same every time.
  CellBrightness(const RenderScene& scene, uint32_t object, Key key);

  Key key;
  std::vector<uint8_t> levels;     // of each triangle
  std::vector<uint32_t> first;     // of each triangle: its first cell
  std::vector<uint32_t> triangle;  // of each cell
  std::vector<float> luminance;    // of each cell, mean
  std::vector<vec3> mean;          // of each triangle
};

class EmitterCells {
 public:
  EmitterCells() = default;
  // areas: of the object's triangles in the world [m²].
  EmitterCells(std::shared_ptr<const CellBrightness> brightness, std::span<const float> areas);

  bool empty() const { return !brightness_; }
  const std::shared_ptr<const CellBrightness>& brightness() const { return brightness_; }

  struct Point {
    uint32_t triangle = 0;
    vec2 weights{0.0f};  // of its second and third corner
    float area = 0.0f;   // 1 / density [m²]
  };
  // u.x chooses the cell; near numbers give near points, so that a well-spread sequence stays so.
  Point sample(vec2 u) const;
  // 1 / density of a point there [m²].
  float areaAt(uint32_t triangle, vec2 weights) const;

 private:
  float areaOf(size_t cell) const;

  std::shared_ptr<const CellBrightness> brightness_;
  std::vector<double> upTo_;     // the weights of the cells up to and with each
  std::vector<float> cellArea_;  // of each triangle's cells [m²]
};

// Uniform over a triangle: the weights of its second and third corner (Turk 1990).
vec2 sampleTriangle(vec2 u);

}  // namespace lamplighter
