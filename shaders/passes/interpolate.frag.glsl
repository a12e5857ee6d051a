// Interpolates the light of pixels in cells from the cell corners (shared/low_resolution.h).
#include "common/cells.glsl"
#include "common/samples.glsl"
#include "shared/bindings.h"

layout(binding = kGPosition) uniform sampler2D uPosition;
layout(binding = kCells) uniform usampler2D uCells;
layout(location = 0) uniform int uBlock;

layout(location = 0) out vec4 outIrradiance;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(uPosition, 0) - 1;
  ivec2 cell = cellOfPixel(pixel, uBlock, textureSize(uSamples, 0));
  if (texelFetch(uCells, cell, 0).r == 0u) discard;
  ivec2 first = uBlock * cell;
  vec2 w = vec2(pixel - first) / vec2(pixelOfSample(cell + 1, uBlock, last) - first);
  vec3 top = mix(sampleAt(cell), sampleAt(cell + ivec2(1, 0)), w.x);
  vec3 bottom = mix(sampleAt(cell + ivec2(0, 1)), sampleAt(cell + 1), w.x);
  outIrradiance = vec4(mix(top, bottom, w.y), 0.0);
}
