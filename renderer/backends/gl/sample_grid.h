// Samples of a picture, one at each corner of its blocks, and which of the cells between them take
// their light from them (shaders/shared/low_resolution.h). Samples of samples are one, too.
#pragma once

#include <vector>

#include "renderer/backends/gl/shading_points.h"
#include "renderer/backends/gl/sum_target.h"

namespace lamplighter::gl {

struct SampleGrid {
  int block = 1;  // pixels a side, or samples
  ShadingPoints points;
  SumTarget sums;
  Texture contrasts, cells;  // R8UI, by cell: shaders/shared/bindings.h
  Framebuffer pointsFramebuffer, contrastsFramebuffer, cellsFramebuffer;

  // Makes room for the samples of a picture. Returns whether it has any cells: else all of its
  // pixels are to be summed, and nothing is held.
  bool resize(int width, int height, int newBlock);
  int columns() const { return sums.width - 1; }  // of cells
  int rows() const { return sums.height - 1; }
  // By pixel of a picture of that size whether it is interpolated (1); empty: there are no cells.
  std::vector<uint8_t> read(int width, int height) const;
  uint64_t bytes() const;
};

}  // namespace lamplighter::gl
