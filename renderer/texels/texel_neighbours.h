// Which texels a point is between: surfaces that stand on a chart, such as a wall on a floor, keep
// the light of one side from the other.
#pragma once

#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/texels/texel_set.h"

namespace lamplighter {

class TexelNeighbours {
 public:
  // Traces up to four rays a texel, to its neighbours in the rectangle of its object. Returns their
  // number.
  uint64_t find(const RenderScene& scene, const RayCaster& rays, const TexelSet& texels);
  // Leaves out texels that the point (world space) does not see, unless it sees none of them.
  // Traces rays only where some neighbours do not see each other.
  void keepVisible(const RenderScene& scene, const RayCaster& rays, const TexelSet& texels,
                   const vec3& position, TexelBlend& blend) const;

 private:
  std::vector<uint8_t> isSplit_;  // by texel: some neighbour is buried, or it does not see it
};

}  // namespace lamplighter
