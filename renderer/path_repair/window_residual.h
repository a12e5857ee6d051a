// The residual of a pixel from all pixels of a small window, mainly from those that show the same
// surface.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/path_repair/halves.h"
#include "renderer/path_repair/repair_guides.h"

namespace lamplighter {

// From 0 to 1: whether pixel `k` shows the plane of pixel `i`, or a plane with a similar normal at
// a distance of less than two pixels.
inline float likeness(const RepairGuides& guides, size_t i, size_t k) {
  const float cosine = glm::dot(guides.normal[i], guides.normal[k]);
  if (cosine <= 0.0f) return 0.0f;
  const float off = 0.5f * glm::dot(guides.normal[i], guides.position[k] - guides.position[i]) /
                    guides.footprint[i];
  const float near = 1.0f - off * off;
  if (near <= 0.0f) return 0.0f;
  const float turn = cosine * cosine * cosine * cosine;
  return turn * turn * turn * turn * near;
}

// For pixels whose neighbours show other surfaces: mouldings, leaves, legs of chairs. Along a
// moulding there are pixels of the same surface that the sparse steps of the bands skip. Other
// surfaces probably receive similar light and have a small weight: the pixel is scaled by the same
// factor as the mean of the window. `residuals`: by pixel, of pixels that show a surface. `radius`:
// of the window [pixels].
inline Halves windowResidual(const RepairGuides& guides, const Image& picture,
                             const std::vector<Halves>& residuals, int x, int y, int radius) {
  constexpr float kLeastLight = 1e-6f, kOther = 0.05f;
  const auto i = static_cast<size_t>(y * guides.width + x);
  Halves sum;
  vec3 light(kLeastLight);
  for (int v = std::max(y - radius, 0); v <= std::min(y + radius, guides.height - 1); ++v)
    for (int u = std::max(x - radius, 0); u <= std::min(x + radius, guides.width - 1); ++u) {
      const auto k = static_cast<size_t>(v * guides.width + u);
      if (guides.normal[k] == vec3(0.0f)) continue;
      const int dx = std::abs(u - x), dy = std::abs(v - y);
      const float weight = likeness(guides, i, k) / static_cast<float>(4 + dx + dy) +
                           kOther / static_cast<float>((1 + dx) * (1 + dy));
      sum.first += weight * residuals[k].first;
      sum.second += weight * residuals[k].second;
      light += weight * picture.pixels[k];
    }
  const vec3 scale = picture.at(x, y) / light;
  return {scale * sum.first, scale * sum.second};
}

}  // namespace lamplighter
