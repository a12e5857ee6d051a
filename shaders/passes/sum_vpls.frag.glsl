// Irradiance at each pixel of the G-buffer from some VPLs of one kind, whose maps lie in one array.
#include "common/normal_packing.glsl"
#include "common/vpls.glsl"
#include "shared/shadow_depth.h"
#include "shared/vpl_shading.h"

layout(binding = kGPosition) uniform sampler2D uPosition;
layout(binding = kGNormals) uniform sampler2D uNormals;
layout(binding = kShadowMaps) uniform sampler2DArray uMaps;

layout(location = 0) uniform int uFirst;  // in uVpls
layout(location = 1) uniform int uEnd;
layout(location = 2) uniform vec4 uClampAndBias;  // ShadingParams

layout(location = 0) out vec4 outIrradiance;

bool occluded(Vpl vpl, vec3 x, vec3 normal) {
  float bias = uClampAndBias.y, resolution = uClampAndBias.z;
  vec3 q = vplToLight(vpl, x - vpl.position.xyz);
  vec3 n = vplToLight(vpl, normal);
#ifdef DIRECTIONAL
  vec2 s = directionalEncode(vpl, q);
#else
  vec2 s = octahedralEncode(q);
#endif
  vec2 texel = shadowTexel(s, resolution);
  vec2 centre = shadowTexelCentre(texel, resolution);
  float depth = texelFetch(uMaps, ivec3(texel, int(vpl.intensity.w)), 0).r;
#ifdef DIRECTIONAL
  return directionalOccluded(vpl, depth, q, n, centre, bias);
#else
  return hemisphereOccluded(depth * (1.0 / kShadowDepthUnit), q, n, centre, bias, resolution);
#endif
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 position = texelFetch(uPosition, pixel, 0);
  if (position.w == 0.0) discard;
  vec4 normals = texelFetch(uNormals, pixel, 0);
  vec3 shading = unpackNormal(normals.xy);
  vec3 geometric = unpackNormal(normals.zw);
  vec3 sum = vec3(0.0);
  for (int i = uFirst; i < uEnd; ++i) {
    Vpl vpl = uVpls[i];
    vpl.position.w = VPL_KIND;  // known to the compiler, which drops the other kinds
    float g = vplGeometry(vpl, position.xyz, shading, geometric, uClampAndBias.x);
    if (g > 0.0 && !(vpl.intensity.w >= 0.0 && occluded(vpl, position.xyz, geometric))) {
      sum += g * vpl.intensity.rgb;
    }
  }
  outIrradiance = vec4(sum, 0.0);
}
