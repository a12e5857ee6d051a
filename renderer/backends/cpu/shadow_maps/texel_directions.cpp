#include "renderer/backends/cpu/shadow_maps/texel_directions.h"

#include <algorithm>
#include <cmath>

#include "renderer/backends/cpu/shadow_maps/shadow_maps.h"
#include "renderer/base/math.h"
#include "shaders/shared/octahedral.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter::cpu {

TexelDirections texelDirections(int resolution, int tile, bool isParallel) {
  TexelDirections d;
  const auto size = static_cast<float>(resolution);
  const int tiles = resolution / tile;
  const auto direction = [&](vec2 texel) {
    const vec2 s = shared::shadowTexelCentre(texel, size);
    return isParallel ? vec3(s, 1.0f) : shared::octahedralDecode(s);
  };
  const auto push = [](const vec3& v, std::vector<float>& x, std::vector<float>& y,
                       std::vector<float>& z) {
    x.push_back(v.x);
    y.push_back(v.y);
    z.push_back(v.z);
  };
  for (int y0 = 0; y0 < resolution; y0 += kBlockHeight) {
    for (int x0 = 0; x0 < resolution; x0 += kBlockWidth) {
      const vec2 half(0.5f * kBlockWidth - 0.5f, 0.5f * kBlockHeight - 0.5f);
      const vec3 middle = direction(vec2(x0, y0) + half);
      const vec3 axis = isParallel ? middle : glm::normalize(middle);
      float cosine = 1.0f, distance = 0.0f;
      for (int lane = 0; lane < kBlockWidth * kBlockHeight; ++lane) {
        const vec3 way = direction(vec2(x0 + lane % kBlockWidth, y0 + lane / kBlockWidth));
        push(way, d.x, d.y, d.z);
        cosine = std::min(cosine, glm::dot(axis, glm::normalize(way)));
        distance = std::max(distance, glm::distance(middle, way));
      }
      push(axis, d.midX, d.midY, d.midZ);
      d.cosine.push_back(isParallel ? distance : cosine);
      d.sine.push_back(isParallel ? 0.0f : std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)));
    }
  }
  for (int y = 0; y <= tiles; ++y)
    for (int x = 0; x < static_cast<int>(TexelDirections::kCornersARow); ++x)
      push(direction(vec2(std::min(x, tiles) * tile, y * tile) - 0.5f), d.cornerX, d.cornerY,
           d.cornerZ);
  return d;
}

}  // namespace lamplighter::cpu
