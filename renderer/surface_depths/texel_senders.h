// Where the bounced light of a point comes from: the links of the texels around it, by sender.
#pragma once

#include <vector>

#include "renderer/surface_depths/texel_links.h"

namespace lamplighter {

// The texels of one object in a node of the tree. World space.
struct TexelSender {
  uint32_t object = 0;
  vec3 centre{0.0f};      // mean position of its texels, weighted by the light that they send
  float area = 0.0f;      // [m²]
  vec3 irradiance{0.0f};  // contribution to the irradiance of the point [W/m²]
};

// The senders of light to a point between texels. `radiosity`: by texel, as gathered along the
// links [W/m²]. The sum of all irradiances is the irradiance of the blended texels.
std::vector<TexelSender> sendersTo(const TexelBlend& blend, const TexelSet& texels,
                                   const TexelTree& tree, const TexelLinks& links,
                                   const std::vector<vec3>& radiosity);

}  // namespace lamplighter
