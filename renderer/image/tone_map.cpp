#include "renderer/image/tone_map.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {

namespace {

// The filmic curve of K. Narkowicz, "ACES Filmic Tone Mapping Curve" (2016), fitted to the
// Academy's.
float filmic(float x) {
  return std::clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f);
}

// Infinite radiance is white; what is no number is black, so that it stands out in a lit picture.
float channel(float radiance, float scale) {
  const float x = radiance * scale;
  if (std::isnan(x)) return 0.0f;
  return encodeSrgb(x > 1e4f ? 1.0f : filmic(std::max(x, 0.0f)));
}

}  // namespace

float encodeSrgb(float v) {
  if (v >= 1.0f) return 1.0f;  // the curve ends one bit below
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

vec3 toneMapPixel(const vec3& radiance, float exposureEv) {
  const float scale = std::exp2(exposureEv);
  return {channel(radiance.r, scale), channel(radiance.g, scale), channel(radiance.b, scale)};
}

Image8 toneMap(const Image& radiance, float exposureEv) {
  Image8 out(radiance.width, radiance.height);
  const float scale = std::exp2(exposureEv);
  for (size_t i = 0; i < radiance.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      out.pixels[4 * i + static_cast<size_t>(c)] =
          static_cast<uint8_t>(channel(radiance.pixels[i][c], scale) * 255.0f + 0.5f);
    }
  }
  return out;
}

}  // namespace lamplighter
