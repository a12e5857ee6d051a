// Importance sampling of surfaces whose emission varies by a texture or an alpha mask: triangles
// are divided into cells, and points are sampled in proportion to the flux of the cells.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Brightness of the cells of an object relative to its emissive factor. Depends only on mesh,
// texture and mask, so edits of position, size and strength do not invalidate it. A triangle is
// split into four at the midpoints of its edges, recursively up to its level. Cells are stored in
// this order, so that neighbours are close in the list.
struct CellBrightness {
  // All inputs: two objects with equal keys have equal brightness.
  struct Key {
    Key(const RenderScene& scene, uint32_t object);
    bool operator==(const Key&) const = default;

    uint64_t content = 0;
    std::shared_ptr<const Image8> emission, mask;  // kept alive, so that their addresses are not
                                                   // reused
  };

  // Samples 4 or 16 fixed points per cell.
  CellBrightness(const RenderScene& scene, uint32_t object, Key key);

  Key key;
  std::vector<uint8_t> levels;     // by triangle
  std::vector<uint32_t> first;     // by triangle: index of its first cell
  std::vector<uint32_t> triangle;  // by cell
  std::vector<float> luminance;    // by cell, mean
  std::vector<vec3> mean;          // by triangle
};

class EmitterCells {
 public:
  EmitterCells() = default;
  // areas: of the object's triangles in world space [m²].
  EmitterCells(std::shared_ptr<const CellBrightness> brightness, std::span<const float> areas);

  bool empty() const { return !brightness_; }
  const std::shared_ptr<const CellBrightness>& brightness() const { return brightness_; }

  struct Point {
    uint32_t triangle = 0;
    vec2 weights{0.0f};  // of the second and third vertex
    float area = 0.0f;   // 1 / density [m²]
  };
  // u.x selects the cell. Close numbers give close points, so that a low-discrepancy sequence stays
  // well distributed.
  Point sample(vec2 u) const;
  // 1 / density of sample() at a point [m²].
  float areaAt(uint32_t triangle, vec2 weights) const;

 private:
  float areaOf(size_t cell) const;

  std::shared_ptr<const CellBrightness> brightness_;
  std::vector<double> upTo_;     // cumulative weights of the cells
  std::vector<float> cellArea_;  // by triangle: area of one of its cells [m²]
};

// Uniform sample of a triangle: the weights of the second and third vertex (Turk 1990).
vec2 sampleTriangle(vec2 u);

}  // namespace lamplighter
