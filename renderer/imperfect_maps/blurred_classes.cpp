#include <algorithm>
#include <vector>

#include <tbb/parallel_for.h>

#include "renderer/imperfect_maps/interleaved_light.h"

namespace lamplighter {
namespace {

// Pixels are on the same surface if the cosine between their normals is at least kLeastCosine, and
// if one lies off the plane of the other by at most kMostOff times the distance between both.
constexpr float kLeastCosine = 0.9f, kMostOff = 0.1f;

struct BlurPixel {
  vec3 position{0.0f}, normal{0.0f};  // a zero normal: nothing is seen
};

bool isSameSurface(const BlurPixel& a, const BlurPixel& b) {
  if (!(glm::dot(a.normal, b.normal) >= kLeastCosine)) return false;
  const vec3 way = b.position - a.position;
  const float off = glm::dot(way, a.normal);
  return off * off <= kMostOff * kMostOff * glm::dot(way, way);
}

// Means along one axis: `step` is the distance of neighbours in memory, `at` the place along the
// axis, of `length`.
vec3 meanAlong(const std::vector<BlurPixel>& pixels, const std::vector<vec3>& in, size_t i,
               size_t step, int at, int length, int side) {
  // A window of `side` pixels about the pixel, inside of the picture, has each class once.
  const int first = std::clamp(at - side / 2, 0, std::max(length - side, 0));
  const int last = std::min(first + side, length);
  vec3 sum(0.0f);
  float count = 0.0f;
  for (int k = first; k < last; ++k) {
    const size_t j = i + static_cast<size_t>(k) * step - static_cast<size_t>(at) * step;
    if (j != i && !isSameSurface(pixels[i], pixels[j])) continue;
    sum += in[j];
    count += 1.0f;
  }
  return sum / count;
}

}  // namespace

Image blurredClasses(const GBufferView& gbuffer, const Image& irradiance, int side) {
  if (side <= 1) return irradiance;
  const int width = irradiance.width, height = irradiance.height;
  const auto across = static_cast<size_t>(width);
  std::vector<BlurPixel> pixels(irradiance.pixels.size());
  Image between(width, height), out(width, height);
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (!gbuffer.isHit(x, y)) continue;
      const cpu::GBuffer& g = gbuffer.packets();
      const size_t i = g.index(x, y);
      pixels[static_cast<size_t>(y) * across + static_cast<size_t>(x)] = {
          {g.px[i], g.py[i], g.pz[i]}, {g.gx[i], g.gy[i], g.gz[i]}};
    }
  });
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const size_t i = static_cast<size_t>(y) * across + static_cast<size_t>(x);
      if (pixels[i].normal != vec3(0.0f))
        between.pixels[i] = meanAlong(pixels, irradiance.pixels, i, 1, x, width, side);
    }
  });
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const size_t i = static_cast<size_t>(y) * across + static_cast<size_t>(x);
      if (pixels[i].normal != vec3(0.0f))
        out.pixels[i] = meanAlong(pixels, between.pixels, i, across, y, height, side);
    }
  });
  return out;
}

}  // namespace lamplighter
