// Luminance histogram of a picture, and the share of pixels that the display cannot show.
#pragma once

#include <array>
#include <cstdint>

#include "renderer/image/tone_map.h"

namespace lamplighter {

struct Histogram {
  // Bins are uniform in stops relative to an exposed luminance of 1. Values outside the range count
  // in the first or last bin.
  static constexpr float kLowest = -12.0f, kHighest = 6.0f;
  static constexpr int kBins = 108;  // each bin is a sixth of a stop

  std::array<uint64_t, kBins> bins{};
  uint64_t pixels = 0;
  // Shares of pixels in [0, 1]. white: at least one channel is displayed at its maximum; black: all
  // channels are displayed as 0. Uses the curve for grey; all tone mappers except agx apply it per
  // channel.
  float white = 0.0f, black = 0.0f;
  float median = 0.0f;  // median luminance, to the precision of a bin [nt]; 0: the picture is black

  uint64_t most() const;
};

Histogram histogramOf(const Image& radiance, float exposureEv, ToneMapper mapper);

}  // namespace lamplighter
