// Discards the holes of alpha-masked occluders.
#include "common/material.glsl"

layout(location = 0) in vec2 vUv0;
layout(location = 1) in vec2 vUv1;
layout(location = 2) in float vAlpha;

void main() {
  float alpha = uMaterial.baseColor.a * vAlpha;
  if (uMaterial.baseColorLookup.v.w > 0.5) {
    alpha *= lookUp(uBaseColor, uMaterial.baseColorLookup, vUv0, vUv1).a;
  }
  if (alpha < uMaterial.options.x) discard;
}
