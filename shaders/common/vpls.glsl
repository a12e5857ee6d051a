// The VPLs of one pass. VPLS_A_PASS is as many as a uniform block of this device holds: a loop over
// a uniform block is nearly twice as fast as over a storage buffer on Mesa's llvmpipe.
#ifndef LAMPLIGHTER_VPLS_GLSL
#define LAMPLIGHTER_VPLS_GLSL
#include "shared/bindings.h"
#include "shared/vpl.h"

layout(std140, binding = kVplBlock) uniform Vpls { Vpl uVpls[VPLS_A_PASS]; };
// The same, for numbers that differ from pixel to pixel: llvmpipe gathers each float of a uniform
// block by itself, and four at a time of a texture. It takes a quarter off a sum by lists.
layout(binding = kVplTexels) uniform samplerBuffer uVplTexels;

Vpl gatheredVpl(int i) {
  return Vpl(texelFetch(uVplTexels, 5 * i), texelFetch(uVplTexels, 5 * i + 1),
             texelFetch(uVplTexels, 5 * i + 2), texelFetch(uVplTexels, 5 * i + 3),
             vec4(0.0));  // the footprint, which irradiance does not depend on
}

#endif
