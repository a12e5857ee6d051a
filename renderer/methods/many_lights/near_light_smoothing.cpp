#include "renderer/methods/many_lights/near_light_smoothing.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

// Of the first batch [pixels], and at most this share of the picture's rows: what is few pixels
// wide must not be blurred.
constexpr float kFirstRadius = 6.0f, kMostOfRows = 1.0f / 60.0f;
// The same surface: normals within 25°, and no further off the plane than a fifth of the way along
// it, so that round things share too.
constexpr float kLeastCosine = 0.9f, kMostSlope = 0.2f;

}  // namespace

int smoothingRadius(uint32_t batch, int height) {
  const float first = std::min(kFirstRadius, kMostOfRows * static_cast<float>(height));
  return static_cast<int>(first / std::sqrt(static_cast<float>(std::max(batch, 1u))));
}

void addSmoothed(std::span<const NearLight::Pixel> pixels, int radius, Image& image) {
  tbb::parallel_for(0, image.height, [&](int y) {
    const auto pixel = [&](int px, int py) -> const NearLight::Pixel& {
      return pixels[static_cast<size_t>(py) * static_cast<size_t>(image.width) +
                    static_cast<size_t>(px)];
    };
    for (int x = 0; x < image.width; ++x) {
      const NearLight::Pixel& own = pixel(x, y);
      if (own.albedo == vec3(0.0f)) continue;
      vec3 sum(0.0f);
      int count = 0;
      for (int py = std::max(y - radius, 0); py <= std::min(y + radius, image.height - 1); ++py) {
        for (int px = std::max(x - radius, 0); px <= std::min(x + radius, image.width - 1); ++px) {
          const NearLight::Pixel& other = pixel(px, py);
          const vec3 way = other.position - own.position;
          const float off = glm::dot(way, own.normal);
          if (glm::dot(other.normal, own.normal) < kLeastCosine ||
              off * off > kMostSlope * kMostSlope * glm::dot(way, way))
            continue;
          sum += other.light;
          ++count;
        }
      }
      image.at(x, y) += own.albedo * sum / static_cast<float>(count);
    }
  });
}

}  // namespace lamplighter
