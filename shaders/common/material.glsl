// The material of the drawn object and its textures.
#ifndef LAMPLIGHTER_MATERIAL_GLSL
#define LAMPLIGHTER_MATERIAL_GLSL
#include "shared/bindings.h"
#include "shared/material.h"

layout(std140, binding = kMaterialBlock) uniform MaterialBlock { SurfaceMaterial uMaterial; };
layout(binding = kBaseColorTexture) uniform sampler2D uBaseColor;
layout(binding = kNormalTexture) uniform sampler2D uNormal;
layout(binding = kEmissiveTexture) uniform sampler2D uEmissive;
layout(binding = kGlossTexture) uniform sampler2D uGloss;

vec2 lookupUv(TextureLookup lookup, vec2 uv0, vec2 uv1) {
  vec3 uv = vec3(lookup.u.w > 0.5 ? uv1 : uv0, 1.0);
  return vec2(dot(lookup.u.xyz, uv), dot(lookup.v.xyz, uv));
}

// All textures have one mipmap level, so both backends filter equally; textureLod makes this
// explicit.
vec4 lookUp(sampler2D image, TextureLookup lookup, vec2 uv0, vec2 uv1) {
  return textureLod(image, lookupUv(lookup, uv0, uv1), 0.0);
}

#endif
