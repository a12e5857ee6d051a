// What a pixel shows, by which a residual is shared among pixels.
#pragma once

#include <vector>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/image/image.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

struct RepairGuides {
  int width = 0, height = 0;
  // By pixel; world space. Zero normals where the sky or a lamp is seen, and beside: a pixel at
  // their border shows some of their brightness, which it must not share with others.
  std::vector<vec3> position;  // [m]
  std::vector<vec3> normal;
  std::vector<vec3> albedo;      // by which the residual is divided: never 0
  std::vector<float> footprint;  // side of a pixel at its distance [m]

  RepairGuides() = default;
  // Whether the sky or a lamp is seen, or beside.
  bool isAtLight(int x, int y) const { return normalAt(x, y) == vec3(0.0f); }
  // Of such a pixel: whether there are others within two pixels.
  bool isAtBorder(int x, int y) const;
  // `white`: surfaces are shown white.
  RepairGuides(const GBufferView& gbuffer, const View& view, bool white);
  // Those of blocks of side × side pixels: of the pixel in the middle, or zero normals if any of
  // them has one. Blocks at the right and lower border may be smaller.
  RepairGuides inBlocks(int side) const;

 private:
  const vec3& normalAt(int x, int y) const { return normal[static_cast<size_t>(y * width + x)]; }
};

// The mean of a picture over each block of these guides.
Image blockMeans(const Image& picture, const RepairGuides& blocks, int side);

}  // namespace lamplighter
