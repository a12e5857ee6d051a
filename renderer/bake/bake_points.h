// The surface points at which the light of a page's texels is computed.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/bake/atlas.h"

namespace lamplighter {

// A point of a texel. A texel has up to four points on its chart, one per quarter, so that shadow
// edges are antialiased. A texel without such a point (in the gutter) uses the nearest point of the
// chart.
struct BakePoint {
  uint16_t x = 0, y = 0;              // position of the texel
  uint32_t object = 0, triangle = 0;  // index into RenderScene::objects; within the object
  float u = 0.0f, v = 0.0f;           // weights of the triangle's second and third vertex
};

// In row-major order of the texels.
std::vector<BakePoint> bakePoints(const RenderScene& scene, const LightMapAtlas& atlas, int page);

}  // namespace lamplighter
