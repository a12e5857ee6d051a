// The light at the samples of the low-resolution pass (shared/low_resolution.h).
#ifndef LAMPLIGHTER_SAMPLES_GLSL
#define LAMPLIGHTER_SAMPLES_GLSL
#include "shared/bindings.h"

layout(binding = kSamples) uniform sampler2D uSamples;

// Clamped at 0: light maps are interpolated, but the shadows subtracted from them are not.
vec3 sampleAt(ivec2 at) {
  return max(texelFetch(uSamples, at, 0).rgb, vec3(0.0));
}

#endif
