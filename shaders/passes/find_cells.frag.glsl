// Finds the cells of the low-resolution pass that are interpolated from their corners
// (shared/low_resolution.h): 1, else 0.
#include "common/cells.glsl"
#include "common/left_out.glsl"
#include "common/normal_packing.glsl"
#include "common/samples.glsl"
#include "shared/bindings.h"
#include "shared/low_resolution.h"

layout(binding = kGPosition) uniform sampler2D uPosition;
layout(binding = kGNormals) uniform sampler2D uNormals;
layout(binding = kPlaces) uniform usampler2D uPlaces;        // of the samples
layout(binding = kContrasts) uniform usampler2D uContrasts;  // output of find_contrasts.frag.glsl
layout(std430, binding = kHardPlaceBuffer) readonly buffer HardPlaces { uint hardPlaces[]; };
layout(location = 0) uniform int uBlock;
layout(location = 1) uniform int uHasHard;   // 0: no place has hard shadows
layout(location = 2) uniform int uHasLinks;  // 0: no light has light linking

layout(location = 0) out uint outIsSmooth;

// Whether the irradiance is similar at the corners of the cell and of its eight neighbours.
bool isSmoothAbout(ivec2 cell) {
  if (!isSmooth(sampleAt(cell), sampleAt(cell + ivec2(1, 0)), sampleAt(cell + ivec2(0, 1)),
                sampleAt(cell + 1), kMostContrast))
    return false;
  ivec2 cells = textureSize(uSamples, 0) - 1;
  for (int i = 0; i < 9; ++i) {
    ivec2 other = cell + ivec2(i % 3, i / 3) - 1;
    bool isThere = all(greaterThanEqual(other, ivec2(0))) && all(lessThan(other, cells));
    if (isThere && texelFetch(uContrasts, other, 0).r != 0u) return false;
  }
  return true;
}

bool isHardAt(ivec2 at) { return hardPlaces[texelFetch(uPlaces, at, 0).r] != 0u; }

bool mayHaveHardShadow(ivec2 cell) {
  return uHasHard != 0 && (isHardAt(cell) || isHardAt(cell + ivec2(1, 0)) ||
                           isHardAt(cell + ivec2(0, 1)) || isHardAt(cell + 1));
}

bool isFlat(ivec2 first, ivec2 end) {
  vec4 origin = texelFetch(uPosition, first, 0);
  if (origin.w == 0.0) return false;
  vec4 normals = texelFetch(uNormals, first, 0);
  vec3 shading = unpackNormal(normals.xy), geometric = unpackNormal(normals.zw);
  uint leftOutBy = uHasLinks != 0 ? leftOutAt(origin.w) : 0u;
  for (int y = first.y; y <= end.y; ++y) {
    for (int x = first.x; x <= end.x; ++x) {
      vec4 position = texelFetch(uPosition, ivec2(x, y), 0);
      if (position.w == 0.0) return false;
      if (uHasLinks != 0 && leftOutAt(position.w) != leftOutBy) return false;
      vec3 normal = unpackNormal(texelFetch(uNormals, ivec2(x, y), 0).xy);
      if (!isOnSurface(origin.xyz, geometric, shading, position.xyz, normal)) return false;
    }
  }
  return true;
}

void main() {
  ivec2 cell = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(uPosition, 0) - 1;
  bool isIt = isSmoothAbout(cell) && !mayHaveHardShadow(cell) &&
              isFlat(uBlock * cell, pixelOfSample(cell + 1, uBlock, last));
  outIsSmooth = isIt ? 1u : 0u;
}
