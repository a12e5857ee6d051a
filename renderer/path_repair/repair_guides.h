// Guides of the filter by pixel: the surfaces among whose pixels a residual is averaged.
#pragma once

#include <vector>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

struct RepairGuides {
  int width = 0, height = 0;
  // By pixel; world space. Zero normals at pixels that show the sky or a lamp, and at their
  // neighbours: a pixel at their border shows some of their brightness, which must not be spread to
  // others.
  std::vector<vec3> position;  // [m]
  std::vector<vec3> normal;
  std::vector<vec3> albedo;      // divisor of the residual: never 0
  std::vector<float> footprint;  // side of a pixel at its distance [m]

  RepairGuides() = default;
  // Whether the pixel shows the sky or a lamp, or is a neighbour of such a pixel.
  bool isAtLight(int x, int y) const { return normalAt(x, y) == vec3(0.0f); }
  // For such a pixel: whether pixels of surfaces are within two pixels.
  bool isAtBorder(int x, int y) const;
  // `white`: surfaces are shown white.
  RepairGuides(const GBufferView& gbuffer, const View& view, bool white);
  // Those of blocks of side × side pixels: of the pixel in the middle, or zero normals if any of
  // them has one. Blocks at the right and lower border may be smaller.
  RepairGuides inBlocks(int side) const;

 private:
  const vec3& normalAt(int x, int y) const { return normal[static_cast<size_t>(y * width + x)]; }
};

}  // namespace lamplighter
