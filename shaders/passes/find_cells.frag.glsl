// Which cells of the low-resolution pass take their light from their corners
// (shared/low_resolution.h): 1, else 0.
#include "common/cells.glsl"
#include "common/left_out.glsl"
#include "common/normal_packing.glsl"
#include "shared/bindings.h"
#include "shared/low_resolution.h"

layout(binding = kGPosition) uniform sampler2D uPosition;
layout(binding = kGNormals) uniform sampler2D uNormals;
layout(binding = kSamples) uniform sampler2D uSamples;
layout(binding = kPlaces) uniform usampler2D uPlaces;  // of samples
layout(std430, binding = kHardPlaceBuffer) readonly buffer HardPlaces { uint hardPlaces[]; };
layout(location = 0) uniform int uBlock;
layout(location = 1) uniform int uHasHard;  // 0: no place is
layout(location = 2) uniform int uHasLinks;  // 0: no light leaves anything out

layout(location = 0) out uint outIsSmooth;

vec3 sampleAt(ivec2 at) {
  return max(texelFetch(uSamples, at, 0).rgb, vec3(0.0));
}

// Whether two samples, of the picture's whole grid, lie on one surface.
bool areOnOneSurface(ivec2 a, ivec2 b) {
  ivec2 last = textureSize(uPosition, 0) - 1;
  a = pixelOfSample(a, uBlock, last);
  b = pixelOfSample(b, uBlock, last);
  vec4 normals = texelFetch(uNormals, a, 0), others = texelFetch(uNormals, b, 0);
  vec4 from = texelFetch(uPosition, a, 0), to = texelFetch(uPosition, b, 0);
  return from.w != 0.0 && to.w != 0.0 &&
         isOnSurface(from.xyz, unpackNormal(normals.zw), unpackNormal(normals.xy), to.xyz,
                     unpackNormal(others.xy));
}

// Whether the irradiance differs much between two corners of the cell, of one surface where no light
// makes hard shadows.
bool differsMuch(ivec2 cell) {
  for (int i = 0; i < 4; ++i) {
    ivec2 a = cell + ivec2(i & 1, i >> 1);
    for (int j = i + 1; j < 4; ++j) {
      ivec2 b = cell + ivec2(j & 1, j >> 1);
      vec3 first = sampleAt(a), second = sampleAt(b);
      if (!isSmooth(first, second, first, second, kMostContrastAbout) &&
          (uHasHard != 0 || areOnOneSurface(a, b)))
        return true;
    }
  }
  return false;
}

// Whether the irradiance differs little enough at the corners of the cell and of those about it.
bool isSmoothAbout(ivec2 cell) {
  if (!isSmooth(sampleAt(cell), sampleAt(cell + ivec2(1, 0)), sampleAt(cell + ivec2(0, 1)),
                sampleAt(cell + 1), kMostContrast))
    return false;
  ivec2 cells = textureSize(uSamples, 0) - 1;
  for (int i = 0; i < 9; ++i) {
    ivec2 other = cell + ivec2(i % 3, i / 3) - 1;
    bool isThere = all(greaterThanEqual(other, ivec2(0))) && all(lessThan(other, cells));
    if (isThere && differsMuch(other)) return false;
  }
  return true;
}

bool isHardAt(ivec2 at) {
  return hardPlaces[texelFetch(uPlaces, at, 0).r] != 0u;
}

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
