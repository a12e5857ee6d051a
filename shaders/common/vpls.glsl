// The VPLs of one pass. VPLS_A_PASS is the capacity of a uniform block on this device: on Mesa's
// llvmpipe a loop over a uniform block is nearly twice as fast as one over a storage buffer.
#ifndef LAMPLIGHTER_VPLS_GLSL
#define LAMPLIGHTER_VPLS_GLSL
#include "shared/bindings.h"
#include "shared/vpl.h"

layout(std140, binding = kVplBlock) uniform Vpls { Vpl uVpls[VPLS_A_PASS]; };
// The same for indices that differ between pixels: llvmpipe gathers each float of a uniform block
// separately, but four floats of a texture at once. This makes a sum by lists 25% faster.
layout(binding = kVplTexels) uniform isamplerBuffer uVplTexels;  // bits of the floats, and slots

Vpl gatheredVpl(int i) {
  ivec4 last = texelFetch(uVplTexels, 5 * i + 3);
  return Vpl(intBitsToFloat(texelFetch(uVplTexels, 5 * i)),
             intBitsToFloat(texelFetch(uVplTexels, 5 * i + 1)),
             intBitsToFloat(texelFetch(uVplTexels, 5 * i + 2)), intBitsToFloat(last.xyz), last.w,
             vec4(0.0));  // the footprint, which does not affect irradiance
}

#endif
