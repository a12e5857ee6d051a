// Intersections of a grid of parallel lines with the surface: all crossings of each line, in order
// (paper 5, section 2.1: a parallel subfield). Instead of the lists of faces in the paper, sorted
// for each direction, each line stores its own crossings, so that triangles may intersect and
// overlap.
#pragma once

#include <span>
#include <vector>

#include "renderer/light_field/field_surface.h"

namespace lamplighter {

// Lines along `along` through the centres of the cells of a grid. The grid is anchored at the
// origin of world space, so that moved objects do not change lines.
struct LineGrid {
  vec3 across, up, along;  // unit, right-handed, world space
  float cell = 1.0f;       // side [m]
  vec2 shift{0.0f};        // of the grid [cells]

  // Position in cells, and along the lines [m].
  vec3 toGrid(const vec3& p) const {
    return {glm::dot(p, across) / cell + shift.x, glm::dot(p, up) / cell + shift.y,
            glm::dot(p, along)};
  }
};

// A triangle projected along the lines. Linear functions on it: value at the origin of the grid,
// and increments per cell to the right and upwards.
struct LineTriangle {
  vec3 depth{0.0f};              // [m]
  std::array<vec2, 3> texels{};  // in the rectangle of the object
  uint32_t object = 0;
  bool hasTexels = false;
  bool facesAlong = false;  // its front side faces along the lines

  float depthAt(const vec2& cell) const { return depth.x + depth.y * cell.x + depth.z * cell.y; }
  vec2 texelsAt(const vec2& cell) const {
    return texels[0] + cell.x * texels[1] + cell.y * texels[2];
  }
};

struct LineCrossing {
  float depth = 0.0f;
  uint32_t triangle = 0;  // index among the triangles that a line meets
};

class LineRaster {
 public:
  // Computes the crossings of all triangles.
  void draw(const RenderScene& scene, const FieldSurface& surface, const LineGrid& grid);

  const LineGrid& grid() const { return grid_; }
  // The triangle with number LineCrossing::triangle.
  const LineTriangle& triangle(uint32_t number) const { return triangles_[number]; }
  // Crossings of the line of a cell, by ascending depth.
  std::span<const LineCrossing> at(int x, int y) const;
  size_t crossings() const { return crossings_.size(); }

 private:
  struct Run {
    int row = 0, first = 0, end = 0;
    uint32_t triangle = 0;
  };
  using Corners = std::array<vec3, 3>;  // in cells and along the lines
  void addTriangle(const RenderScene& scene, const FieldSurface::Triangle& triangle,
                   const Corners& p);
  void addMasked(const RenderScene& scene, const FieldSurface::Triangle& triangle, const Run& run,
                 const Corners& p);

  LineGrid grid_;
  glm::ivec2 low_{0}, size_{0};  // window of cells
  std::vector<vec3> positions_;  // positions of the scene, in cells and along the lines
  std::vector<LineTriangle> triangles_;
  std::vector<Run> runs_;
  std::vector<uint32_t> starts_;  // by cell, plus one entry
  std::vector<LineCrossing> crossings_;
};

}  // namespace lamplighter
