#include "renderer/surface_depths/texel_sight.h"

#include <algorithm>

#include "renderer/surface_depths/link_walk.h"
#include "renderer/texels/texel_rays.h"

namespace lamplighter {

float queryErrorOf(uint32_t texel, const RenderScene& scene, const RayCaster& rays,
                   const TexelSet& texels, const TexelTree& tree, const SurfaceDepths& depths,
                   float linkError, size_t most) {
  std::vector<uint32_t> tests;  // texels to test
  walkLinks(texels[texel].spot, texel, texels, tree, linkError, [&](uint32_t node, float) {
    forEachTested(tree, tree[node], [&](uint32_t sender) { tests.push_back(sender); });
  });
  const size_t count = std::min(most, tests.size());
  if (count == 0) return 0.0f;
  size_t wrong = 0;
  for (size_t k = 0; k < count; ++k) {
    const vec3& point = texels[tests[(2 * k + 1) * tests.size() / (2 * count)]].spot.position;
    wrong +=
        depths.sees(texels[texel], texel, point) != seesByRay(scene, rays, texels[texel], point)
            ? 1
            : 0;
  }
  return static_cast<float>(wrong) / static_cast<float>(count);
}

}  // namespace lamplighter
