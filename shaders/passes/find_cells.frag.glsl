// Which cells of the low-resolution pass take their light from their corners
// (shared/low_resolution.h): 1, else 0.
#include "common/cells.glsl"
#include "common/normal_packing.glsl"
#include "shared/bindings.h"
#include "shared/low_resolution.h"

layout(binding = kGPosition) uniform sampler2D uPosition;
layout(binding = kGNormals) uniform sampler2D uNormals;
layout(binding = kSamples) uniform sampler2D uSamples;
layout(location = 0) uniform int uBlock;

layout(location = 0) out uint outIsSmooth;

vec3 sampleAt(ivec2 at) {
  return max(texelFetch(uSamples, at, 0).rgb, vec3(0.0));
}

bool isFlat(ivec2 first, ivec2 end) {
  vec4 origin = texelFetch(uPosition, first, 0);
  if (origin.w == 0.0) return false;
  vec4 normals = texelFetch(uNormals, first, 0);
  vec3 shading = unpackNormal(normals.xy), geometric = unpackNormal(normals.zw);
  for (int y = first.y; y <= end.y; ++y) {
    for (int x = first.x; x <= end.x; ++x) {
      vec4 position = texelFetch(uPosition, ivec2(x, y), 0);
      if (position.w == 0.0) return false;
      vec3 normal = unpackNormal(texelFetch(uNormals, ivec2(x, y), 0).xy);
      if (!isOnSurface(origin.xyz, geometric, shading, position.xyz, normal)) return false;
    }
  }
  return true;
}

void main() {
  ivec2 cell = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(uPosition, 0) - 1;
  bool smoothly = isSmooth(sampleAt(cell), sampleAt(cell + ivec2(1, 0)), sampleAt(cell + ivec2(0, 1)),
                           sampleAt(cell + 1));
  smoothly = smoothly && isFlat(uBlock * cell, pixelOfSample(cell + 1, uBlock, last));
  outIsSmooth = smoothly ? 1u : 0u;
}
