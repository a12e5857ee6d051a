// How the gl backend keeps a hemisphere map's 1/w in a depth buffer: as depth = kShadowDepthUnit /
// w, which is in [0, 1] for every w that a map can hold (occluders nearer than the unit are the
// surface that the VPL lies on). A power of two, so that scaling loses no bit.
#ifndef LAMPLIGHTER_SHARED_SHADOW_DEPTH_H
#define LAMPLIGHTER_SHARED_SHADOW_DEPTH_H
#include "interop.h"

SHARED_BEGIN

SHARED_CONST float kShadowDepthUnit = 1.0f / 131072.0f;  // 2⁻¹⁷ m

SHARED_END
#endif
