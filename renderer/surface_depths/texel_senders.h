// Where the bounced light of a point comes from: the links of the texels around it, by sender.
#pragma once

#include <vector>

#include "renderer/surface_depths/texel_links.h"

namespace lamplighter {

// The texels of one object in a node of the tree. World space.
struct TexelSender {
  uint32_t object = 0;
  vec3 centre{0.0f};      // mean of the places of its texels, by the light that they send
  float area = 0.0f;      // [m²]
  vec3 irradiance{0.0f};  // that it brings to the point [W/m²]
};

// Those that send light to a point between texels. `radiosity`: of the texels, as the links carry
// it [W/m²]. The sum of all irradiances is that of the texels, by the weights of the blend.
std::vector<TexelSender> sendersTo(const TexelBlend& blend, const TexelSet& texels,
                                   const TexelTree& tree, const TexelLinks& links,
                                   const std::vector<vec3>& radiosity);

}  // namespace lamplighter
