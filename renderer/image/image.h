// Images in main memory.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter {

// Linear, scene-referred radiance [W/(m² sr)] or any other float quantity; RGB interleaved, row 0
// is the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<vec3> pixels;

  Image() = default;
  Image(int w, int h, const vec3& fill = vec3(0.0f))
      : width(w), height(h), pixels(static_cast<size_t>(w) * h, fill) {}
  vec3& at(int x, int y) { return pixels[static_cast<size_t>(y) * width + x]; }
  const vec3& at(int x, int y) const { return pixels[static_cast<size_t>(y) * width + x]; }
  bool empty() const { return pixels.empty(); }
};

// Eight bits per channel: display-referred (sRGB-encoded) or data, depending on the use. RGBA
// interleaved, row 0 is the top.
struct Image8 {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> pixels;  // 4 * width * height

  Image8() = default;
  Image8(int w, int h) : width(w), height(h), pixels(size_t{4} * w * h, 255) {}
  const uint8_t* at(int x, int y) const {
    return &pixels[4 * (static_cast<size_t>(y) * width + x)];
  }
  uint8_t* at(int x, int y) { return &pixels[4 * (static_cast<size_t>(y) * width + x)]; }
};

}  // namespace lamplighter
