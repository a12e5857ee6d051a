// The light at the samples of the low-resolution pass (shared/low_resolution.h).
#ifndef LAMPLIGHTER_SAMPLES_GLSL
#define LAMPLIGHTER_SAMPLES_GLSL
#include "shared/bindings.h"

layout(binding = kSamples) uniform sampler2D uSamples;

// Light maps are interpolated and the shadows taken away from them are not: no less than no light.
vec3 sampleAt(ivec2 at) {
  return max(texelFetch(uSamples, at, 0).rgb, vec3(0.0));
}

#endif
