// How often each brightness is in a picture, and how much of it the display cannot show.
#pragma once

#include <array>
#include <cstdint>

#include "renderer/image/tone_map.h"

namespace lamplighter {

struct Histogram {
  // Exposed luminance in stops over 1, evenly; what is darker or brighter counts in the first and
  // last bin.
  static constexpr float kLowest = -12.0f, kHighest = 6.0f;
  static constexpr int kBins = 108;  // a sixth of a stop each

  std::array<uint64_t, kBins> bins{};
  uint64_t pixels = 0;
  // Shares in [0, 1]: of pixels of which a channel is shown as white as can be, and of those of
  // which all are black. By the curve of grey, which all mappers but agx have for each channel.
  float white = 0.0f, black = 0.0f;
  float median = 0.0f;  // luminance, to a bin [nt]; 0: the picture is black

  uint64_t most() const;
};

Histogram histogramOf(const Image& radiance, float exposureEv, ToneMapper mapper);

}  // namespace lamplighter
