// The residual of a pixel from all pixels of a small window, whatever surfaces they show.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/path_repair/halves.h"
#include "renderer/path_repair/repair_guides.h"

namespace lamplighter {

// For pixels whose neighbours show other surfaces: leaves, legs of chairs. Their surfaces differ,
// but probably receive similar light: the pixel is scaled by the same factor as the mean of the
// window. `residuals`: by pixel, of pixels that show a surface. `radius`: of the window [pixels].
inline Halves windowResidual(const RepairGuides& guides, const Image& picture,
                             const std::vector<Halves>& residuals, int x, int y, int radius) {
  constexpr float kLeastLight = 1e-6f;
  Halves sum;
  vec3 light(kLeastLight);
  for (int v = std::max(y - radius, 0); v <= std::min(y + radius, guides.height - 1); ++v)
    for (int u = std::max(x - radius, 0); u <= std::min(x + radius, guides.width - 1); ++u) {
      const auto k = static_cast<size_t>(v * guides.width + u);
      if (guides.normal[k] == vec3(0.0f)) continue;
      const float weight = 1.0f / static_cast<float>((1 + std::abs(u - x)) * (1 + std::abs(v - y)));
      sum.first += weight * residuals[k].first;
      sum.second += weight * residuals[k].second;
      light += weight * picture.pixels[k];
    }
  const vec3 scale = picture.at(x, y) / light;
  return {scale * sum.first, scale * sum.second};
}

}  // namespace lamplighter
