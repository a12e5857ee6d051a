#include "renderer/texels/texel_neighbours.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/texels/texel_rays.h"

namespace lamplighter {
namespace {

// Rays between neighbours are lifted off curved surfaces by this share of the side of a texel.
constexpr float kLift = 0.1f;

// Whether anything blocks the line between a point of the surface and the centre of a texel.
bool seesTexel(const RenderScene& scene, const RayCaster& rays, const vec3& position,
               const SurfaceTexel& texel) {
  const vec3 lift = kLift * std::sqrt(texel.area) * texel.spot.geometricNormal;
  const vec3 d = texel.spot.position - position;
  return d == vec3(0.0f) || !blocksBouncedLight(scene, rays, {position + lift, 0.0f, d, 1.0f});
}

}  // namespace

uint64_t TexelNeighbours::find(const RenderScene& scene, const RayCaster& rays,
                               const TexelSet& texels) {
  std::vector<std::atomic<uint8_t>> isSplit(texels.size());
  std::atomic<uint64_t> traced = 0;
  tbb::parallel_for(size_t{0}, texels.parts().size(), [&](size_t side) {
    const TexelSet::Part& part = texels.parts()[side];
    const auto at = [&](int x, int y) {
      const bool isIn = x >= 0 && y >= 0 && x < part.size.x && y < part.size.y;
      return isIn ? part.texelAt[static_cast<size_t>(y * part.size.x + x)] : TexelSet::kNone;
    };
    tbb::parallel_for(part.first, part.first + part.count, [&](uint32_t t) {
      const glm::ivec2 here = texels[t].at;
      for (const glm::ivec2 by : {glm::ivec2(1, 0), {-1, 1}, {0, 1}, {1, 1}}) {
        const uint32_t other = at(here.x + by.x, here.y + by.y);
        if (other == TexelSet::kNone || texels[other].chart != texels[t].chart) continue;
        ++traced;
        const bool areTogether = !texels.isBuried(t) && !texels.isBuried(other) &&
                                 seesTexel(scene, rays, texels[t].spot.position, texels[other]);
        if (!areTogether) isSplit[t] = isSplit[other] = 1;
      }
    });
  });
  isSplit_.assign(isSplit.begin(), isSplit.end());
  return traced;
}

void TexelNeighbours::keepVisible(const RenderScene& scene, const RayCaster& rays,
                                  const TexelSet& texels, const vec3& position,
                                  TexelBlend& blend) const {
  const auto isUsed = [&](size_t k) { return blend.weights[k] > 0.0f; };
  bool isSplit = false;
  for (size_t k = 0; k < 4; ++k) isSplit = isSplit || (isUsed(k) && isSplit_[blend.texels[k]] != 0);
  if (!isSplit) return;
  std::array<float, 4> weights{};
  float sum = 0.0f;
  for (size_t k = 0; k < 4; ++k) {
    if (!isUsed(k) || !seesTexel(scene, rays, position, texels[blend.texels[k]])) continue;
    weights[k] = blend.weights[k];
    sum += weights[k];
  }
  if (sum <= 0.0f) return;
  for (size_t k = 0; k < 4; ++k) blend.weights[k] = weights[k] / sum;
}

}  // namespace lamplighter
