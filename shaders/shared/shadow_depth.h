// How the gl backend stores 1/w of a hemisphere map in a depth buffer: depth = kShadowDepthUnit /
// w, which is in [0, 1] for every w that a map can hold (nearer occluders are the surface that the
// VPL lies on). The unit is a power of two, so that scaling is exact.
#ifndef LAMPLIGHTER_SHARED_SHADOW_DEPTH_H
#define LAMPLIGHTER_SHARED_SHADOW_DEPTH_H
#include "interop.h"

SHARED_BEGIN

SHARED_CONST float kShadowDepthUnit = 1.0f / 131072.0f;  // 2⁻¹⁷ m

SHARED_END
#endif
