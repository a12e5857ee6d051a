// Light linking: which lights do not light a pixel (renderer/scene/light_linking.h).
#ifndef LAMPLIGHTER_LEFT_OUT_GLSL
#define LAMPLIGHTER_LEFT_OUT_GLSL
#include "shared/bindings.h"

layout(std430, binding = kLeftOutBuffer) readonly buffer LeftOut { uint leftOut[]; };

// The link bits of the lights that do not light the triangle; w: of kGPosition, at a hit.
uint leftOutAt(float w) {
  return leftOut[floatBitsToUint(w) - uint(kTriangleBits)];
}

// link: Vpl.footprint.y
bool isLeftOut(uint leftOutBy, float link) {
  return link > 0.5 && (leftOutBy >> (uint(link + 0.5) - 1u) & 1u) != 0u;
}

#endif
