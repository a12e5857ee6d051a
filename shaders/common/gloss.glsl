// The lobe of a pixel (shared/brdf.h), from the G-buffer.
#ifndef LAMPLIGHTER_GLOSS_GLSL
#define LAMPLIGHTER_GLOSS_GLSL
#include "common/normal_packing.glsl"
#include "shared/bindings.h"
#include "shared/brdf.h"

layout(binding = kGPosition) uniform sampler2D uPosition;
layout(binding = kGNormals) uniform sampler2D uNormals;
layout(binding = kGAlbedo) uniform sampler2D uAlbedo;
layout(binding = kGGloss) uniform sampler2D uGloss;
layout(location = 0) uniform vec3 uEye;
layout(location = 1) uniform float uLeastRoughness;

struct GlossyPoint {
  vec3 position, shading, geometric, toEye;
  vec3 albedo;
  float metallic, roughness;
};

// Discards pixels that are not glossy.
GlossyPoint glossyPoint(ivec2 pixel) {
  vec2 gloss = texelFetch(uGloss, pixel, 0).xy;
  vec4 position = texelFetch(uPosition, pixel, 0);
  if (position.w == 0.0 || !isGlossy(gloss.x, gloss.y)) discard;
  vec4 normals = texelFetch(uNormals, pixel, 0);
  return GlossyPoint(position.xyz, unpackNormal(normals.xy), unpackNormal(normals.zw),
                     normalize(uEye - position.xyz), texelFetch(uAlbedo, pixel, 0).rgb, gloss.x,
                     gloss.y);
}

#endif
