// Error metrics between two pictures. B is the reference. A NaN in either makes every mean NaN.
#pragma once

#include "renderer/image/image.h"

namespace lamplighter {

struct Metrics {
  double relRmse = 0.0;  // sqrt(mean((A−B)²)) / mean(B), over all pixels and channels
  double relMse = 0.0;   // mean((A−B)² / (B² + (0.05·mean B)²))
  double bias = 1.0;     // mean A / mean B; 1: no bias
  double max = 0.0;      // largest |A−B| of a channel
  double ssim = 0.0;     // of tone-mapped luminance; 1: equal
  double meanA = 0.0, meanB = 0.0;
};

// Throws InputError if the sizes differ. `mask`: only pixels with .r > 0.5 count; null: all count.
Metrics compareImages(const Image& a, const Image& b, const Image* mask = nullptr);

// Only Metrics::relRmse, at a fraction of the cost of all metrics. Throws InputError if the sizes
// differ.
double relRmse(const Image& a, const Image& b, const Image* mask = nullptr);

// |A−B| relative to mean B, as colours from black (0) to white (≥ 1).
Image8 heatMap(const Image& a, const Image& b);

}  // namespace lamplighter
