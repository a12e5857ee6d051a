// The shadow map look-up (shared/vpl_shading.h) for one kind of VPL: with DIRECTIONAL, or without
// it.
#ifndef LAMPLIGHTER_SHADOW_LOOK_UP_GLSL
#define LAMPLIGHTER_SHADOW_LOOK_UP_GLSL
#include "shared/bindings.h"
#include "shared/shadow_depth.h"
#include "shared/vpl_shading.h"

layout(binding = kShadowMaps) uniform sampler2DArray uMaps;

// normal: the geometric normal; clampAndBias: as in ShadingParams.
bool occluded(Vpl vpl, vec3 x, vec3 normal, vec4 clampAndBias) {
  float bias = clampAndBias.y, resolution = clampAndBias.z;
  vec3 q = vplToLight(vpl, x - vpl.position.xyz);
  vec3 n = vplToLight(vpl, normal);
#ifdef DIRECTIONAL
  vec2 s = directionalEncode(vpl, q);
#else
  vec2 s = octahedralEncode(q);
#endif
  vec2 texel = shadowTexel(s, resolution);
  vec2 centre = shadowTexelCentre(texel, resolution);
  float depth = texelFetch(uMaps, ivec3(texel, vpl.slot), 0).r;
#ifdef DIRECTIONAL
  return directionalOccluded(vpl, depth, q, n, centre, bias, resolution);
#else
  return hemisphereOccluded(depth * (1.0 / kShadowDepthUnit), q, n, centre, bias, resolution);
#endif
}

#endif
