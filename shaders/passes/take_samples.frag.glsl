// Copies the shading points of the samples of the low-resolution pass (shared/low_resolution.h).
#include "common/cells.glsl"
#include "shared/bindings.h"

layout(binding = kGPosition) uniform sampler2D uPosition;
layout(binding = kGNormals) uniform sampler2D uNormals;
layout(location = 0) uniform int uBlock;

layout(location = 0) out vec4 outPosition;
layout(location = 1) out vec4 outNormals;

void main() {
  ivec2 pixel = pixelOfSample(ivec2(gl_FragCoord.xy), uBlock, textureSize(uPosition, 0) - 1);
  outPosition = texelFetch(uPosition, pixel, 0);
  outNormals = texelFetch(uNormals, pixel, 0);
}
