// For scan_gltest.cpp: samples a cumulative distribution of one row with each of the given numbers.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Cdf { float cdf[]; };
layout(std430, binding = 1) readonly buffer Numbers { float numbers[]; };
layout(std430, binding = 2) writeonly buffer Found { uint found[]; };
layout(std430, binding = 3) writeonly buffer Within { float within[]; };
layout(location = 0) uniform int uCount;

#define CDF_VALUES cdf
#include "common/cdf.glsl"

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= numbers.length()) return;
  float rest;
  found[i] = uint(sampleCdf(0, uCount, numbers[i], rest));
  within[i] = rest;
}
