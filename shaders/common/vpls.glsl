// The VPLs of one pass. VPLS_A_PASS is as many as a uniform block of this device holds: a loop over
// a uniform block is nearly twice as fast as over a storage buffer on Mesa's llvmpipe.
#ifndef LAMPLIGHTER_VPLS_GLSL
#define LAMPLIGHTER_VPLS_GLSL
#include "shared/bindings.h"
#include "shared/vpl.h"

layout(std140, binding = kVplBlock) uniform Vpls { Vpl uVpls[VPLS_A_PASS]; };

#endif
