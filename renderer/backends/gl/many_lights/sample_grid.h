// Samples of a picture, one at each corner of its blocks, and the cells between them that are
// interpolated (shaders/shared/low_resolution.h). The samples can themselves be sampled by another
// grid.
#pragma once

#include <vector>

#include "renderer/backends/gl/many_lights/sum_target.h"
#include "renderer/backends/gl/shading_points.h"
#include "renderer/gl/waits.h"

namespace lamplighter::gl {

struct SampleGrid {
  int block = 1;  // pixels, or samples, per side
  ShadingPoints points;
  SumTarget sums;
  Texture contrasts, cells;  // R8UI, by cell: shaders/shared/bindings.h
  Framebuffer pointsFramebuffer, contrastsFramebuffer, cellsFramebuffer;

  // Allocates the samples of a picture. Returns whether it has any cells. If not, all its pixels
  // must be summed, and nothing is allocated.
  bool resize(int width, int height, int newBlock);
  int columns() const { return sums.width - 1; }  // number of cells per row
  int rows() const { return sums.height - 1; }
  // By pixel of a picture of that size, 1 if it is interpolated; empty: there are no cells.
  std::vector<uint8_t> read(Waits& waits, int width, int height) const;
  uint64_t bytes() const;
};

}  // namespace lamplighter::gl
