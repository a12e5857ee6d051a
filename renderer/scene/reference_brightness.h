// The brightness for which light samples are chosen. Light is linear: if the samples of a light do
// not depend on its exact brightness, an edit of brightness only scales their light. So sampling
// uses a white light with a reference brightness, which changes in steps of a factor of 16, and a
// gain per channel makes it the light of the scene. A light that is switched off keeps its samples,
// with a gain of 0.
#pragma once

#include <cmath>

#include "renderer/base/math.h"

namespace lamplighter {

// The power of 16 that is nearest on a logarithmic scale to the luminance of a light that is on; 0
// for a black light.
inline float referenceBrightness(const vec3& nominal) {
  const float brightness = luminance(nominal);
  if (!(brightness > 0.0f)) return 0.0f;
  // Integer exponents, because the last bits of a logarithm depend on the processor.
  const int exponent = std::ilogb(brightness) + 2;
  const int step = exponent >= 0 ? exponent / 4 : -((3 - exponent) / 4);
  return std::ldexp(1.0f, 4 * step);
}

}  // namespace lamplighter
