// How far two pictures are apart. B is the reference. NaN in either poisons every mean.
#pragma once

#include "renderer/image/image.h"

namespace lamplighter {

struct Metrics {
  double relRmse = 0.0;  // sqrt(mean((A−B)²)) / mean(B), over all pixels and channels
  double relMse = 0.0;   // mean((A−B)² / (B² + (0.05·mean B)²))
  double bias = 1.0;     // mean A / mean B, 1: none
  double max = 0.0;      // largest |A−B| of a channel
  double ssim = 0.0;     // of tone-mapped luminance, 1: the same
  double meanA = 0.0, meanB = 0.0;
};

// Throws InputError when the sizes differ. `mask` (null: all): pixels whose .r > 0.5 count.
Metrics compareImages(const Image& a, const Image& b, const Image* mask = nullptr);

// |A−B| relative to mean B, as colours from black (0) through to white (≥ 1).
Image8 heatMap(const Image& a, const Image& b);

}  // namespace lamplighter
