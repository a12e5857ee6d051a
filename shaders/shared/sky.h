// The sky's radiance by direction, the same in pictures, light samples and the reference.
#ifndef LAMPLIGHTER_SHARED_SKY_H
#define LAMPLIGHTER_SHARED_SKY_H
#include "interop.h"

SHARED_BEGIN

SHARED_CONST int kSkyConstant = 0;
SHARED_CONST int kSkyGradient = 1;
SHARED_CONST int kSkyImage = 2;

// y: the height of the unit direction (the sine of the elevation). L = horizon + y (zenith −
// horizon) for y ≥ 0, else ground.
SHARED_FUNCTION vec3 skyGradient(vec3 zenith, vec3 horizon, vec3 ground, float y) {
  return y < 0.0f ? ground : horizon + y * (zenith - horizon);
}

// The position of a unit direction in an equirectangular picture: (0, 0) is its top left corner,
// (1, 1) its bottom right one; y is up. With rotation 0, its middle is towards −Z and its right
// half towards +X; `rotation` turns it about Y [rad], counter-clockwise seen from above.
// By atan() in both directions: acos() of GPUs has errors of 1e-4.
SHARED_FUNCTION vec2 skyCoordinates(vec3 d, float rotation) {
  const float kInversePi = 0.318309886f;
  float u = 0.5f * kInversePi * (atan(d.x, -d.z) + rotation) + 0.5f;
  return vec2(u - floor(u), kInversePi * atan(length(vec2(d.x, d.z)), d.y));
}

SHARED_END
#endif
