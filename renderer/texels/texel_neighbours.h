// Visibility between neighbouring texels: a surface that stands on a chart, such as a wall on a
// floor, separates the light of its two sides.
#pragma once

#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/texels/texel_set.h"

namespace lamplighter {

class TexelNeighbours {
 public:
  // Traces up to four rays per texel, to its neighbours in the rectangle of its object. Returns the
  // number of rays.
  uint64_t find(const RenderScene& scene, const RayCaster& rays, const TexelSet& texels);
  // Removes texels from `blend` that are not visible from the point (world space), unless none is
  // visible. Traces rays only where neighbours do not see each other.
  void keepVisible(const RenderScene& scene, const RayCaster& rays, const TexelSet& texels,
                   const vec3& position, TexelBlend& blend) const;

 private:
  std::vector<uint8_t> isSplit_;  // by texel: a neighbour is buried or not visible from it
};

}  // namespace lamplighter
