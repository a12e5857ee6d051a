// Comparisons of pictures in tests, beside the metrics of the renderer.
#pragma once

#include "renderer/image/image.h"

namespace lamplighter::test {

// The share of the pixels with a channel that differs by more than absolute + relative · |b|.
// Pixels with NaN differ, and all pixels of pictures of different sizes.
double differingShare(const Image& a, const Image& b, float absolute, float relative = 0.0f);

}  // namespace lamplighter::test
