// Positions of the samples of antialiasing in a pixel.
#pragma once

#include "renderer/base/math.h"

namespace lamplighter {

// The offset [pixels] of sample i of n from the centre of a pixel: a Hammersley set whose mean is
// the centre.
inline vec2 pixelJitter(int i, int n) {
  float inverse = 0.0f, digit = 0.5f, size = 1.0f;
  for (int rest = i; rest > 0; rest /= 2, digit *= 0.5f) {
    if (rest % 2 != 0) inverse += digit;
  }
  for (int power = 1; power < n; power *= 2) size *= 0.5f;
  const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
  return {along - 0.5f, inverse + 0.5f * size - 0.5f};
}

}  // namespace lamplighter
