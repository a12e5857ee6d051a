// Finds the cells of the low-resolution pass where the irradiance of two corners differs much
// (shared/low_resolution.h): 1, else 0. A separate pass, because each cell later reads all its
// neighbours.
#include "common/cells.glsl"
#include "common/normal_packing.glsl"
#include "common/samples.glsl"
#include "shared/bindings.h"
#include "shared/low_resolution.h"

layout(binding = kGPosition) uniform sampler2D uPosition;
layout(binding = kGNormals) uniform sampler2D uNormals;
layout(location = 0) uniform int uBlock;
layout(location = 1) uniform int uHasHard;  // 0: no light makes hard shadows

layout(location = 0) out uint outDiffers;

struct Corner {
  vec3 irradiance;
  vec4 position, normals;  // as in the G-buffer
};

Corner cornerAt(ivec2 at) {
  ivec2 pixel = pixelOfSample(at, uBlock, textureSize(uPosition, 0) - 1);
  return Corner(sampleAt(at), texelFetch(uPosition, pixel, 0), texelFetch(uNormals, pixel, 0));
}

bool areOnOneSurface(Corner a, Corner b) {
  return a.position.w != 0.0 && b.position.w != 0.0 &&
         isOnSurface(a.position.xyz, unpackNormal(a.normals.zw), unpackNormal(a.normals.xy),
                     b.position.xyz, unpackNormal(b.normals.xy));
}

// Whether the irradiance differs. Without hard-shadow lights only corners on one surface are
// compared.
bool differ(Corner a, Corner b) {
  return !isSmooth(a.irradiance, b.irradiance, a.irradiance, b.irradiance, kMostContrastAbout) &&
         (uHasHard != 0 || areOnOneSurface(a, b));
}

void main() {
  ivec2 cell = ivec2(gl_FragCoord.xy);
  Corner a = cornerAt(cell), b = cornerAt(cell + ivec2(1, 0));
  Corner c = cornerAt(cell + ivec2(0, 1)), d = cornerAt(cell + 1);
  bool differs =
      differ(a, b) || differ(a, c) || differ(a, d) || differ(b, c) || differ(b, d) || differ(c, d);
  outDiffers = differs ? 1u : 0u;
}
