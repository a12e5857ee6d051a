#include "renderer/bias_compensation/bias_compensation_filter.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

// Radius for the first batch [pixels], and its limit as a share of the picture's rows, so that
// details a few pixels wide are not blurred.
constexpr float kFirstRadius = 6.0f, kMostOfRows = 1.0f / 60.0f;
// The same surface: normals within 25°, and a distance from the plane of at most a fifth of the
// distance along it, so that curved surfaces share too.
constexpr float kLeastCosine = 0.9f, kMostSlope = 0.2f;

bool isSameSurface(const BiasCompensation::Pixel& own, const BiasCompensation::Pixel& other) {
  const vec3 way = other.position - own.position;
  const float off = glm::dot(way, own.normal);
  return glm::dot(other.normal, own.normal) >= kLeastCosine &&
         off * off <= kMostSlope * kMostSlope * glm::dot(way, way);
}

}  // namespace

int filterRadius(uint32_t batch, int height) {
  const float first = std::min(kFirstRadius, kMostOfRows * static_cast<float>(height));
  return static_cast<int>(first / std::sqrt(static_cast<float>(std::max(batch, 1u))));
}

// First along rows, then along columns of the result. Where both lie on one surface this equals the
// mean over the whole square, with a sixth of the reads.
void addSmoothed(std::span<const BiasCompensation::Pixel> pixels, int radius, Image& image) {
  const int width = image.width, height = image.height;
  const auto index = [&](int x, int y) {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  };
  struct Sum {
    vec3 light{0.0f};
    float count = 0.0f;
  };
  std::vector<Sum> rows(pixels.size());
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const BiasCompensation::Pixel& own = pixels[index(x, y)];
      if (own.albedo == vec3(0.0f)) continue;
      Sum& sum = rows[index(x, y)];
      for (int px = std::max(x - radius, 0); px <= std::min(x + radius, width - 1); ++px) {
        const BiasCompensation::Pixel& other = pixels[index(px, y)];
        if (!isSameSurface(own, other)) continue;
        sum.light += other.light;
        sum.count += 1.0f;
      }
    }
  });
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const BiasCompensation::Pixel& own = pixels[index(x, y)];
      if (own.albedo == vec3(0.0f)) continue;
      Sum sum;
      for (int py = std::max(y - radius, 0); py <= std::min(y + radius, height - 1); ++py) {
        if (!isSameSurface(own, pixels[index(x, py)])) continue;
        sum.light += rows[index(x, py)].light;
        sum.count += rows[index(x, py)].count;
      }
      image.at(x, y) += own.albedo * sum.light / sum.count;
    }
  });
}

}  // namespace lamplighter
