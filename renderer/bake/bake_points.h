// Where a page's texels lie on the surfaces: the points at which its light is found.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/bake/atlas.h"

namespace lamplighter {

// A point of a texel; a texel has up to four, one in each quarter, that lie on its chart, so that
// edges of shadows are smooth. Where none does, in the gutter, it has the nearest of the chart.
struct BakePoint {
  uint16_t x = 0, y = 0;              // of the texel
  uint32_t object = 0, triangle = 0;  // index into RenderScene::objects; within the object
  float u = 0.0f, v = 0.0f;           // weights of the triangle's second and third vertex
};

// In the order of rows and columns.
std::vector<BakePoint> bakePoints(const RenderScene& scene, const LightMapAtlas& atlas, int page);

}  // namespace lamplighter
