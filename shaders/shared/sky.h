// The sky's radiance by direction, the same in pictures, in light samples and in the reference.
#ifndef LAMPLIGHTER_SHARED_SKY_H
#define LAMPLIGHTER_SHARED_SKY_H
#include "interop.h"

SHARED_BEGIN

SHARED_CONST int kSkyConstant = 0;
SHARED_CONST int kSkyGradient = 1;
SHARED_CONST int kSkyImage = 2;

// y: the unit direction's height. Above the horizon linear in it (so in the sine of the elevation),
// below the ground alone: L = horizon + y (zenith − horizon) for y ≥ 0, else ground.
SHARED_FUNCTION vec3 skyGradient(vec3 zenith, vec3 horizon, vec3 ground, float y) {
  return y < 0.0f ? ground : horizon + y * (zenith - horizon);
}

// Where a unit direction falls in an equirectangular picture, (0, 0) its top left corner, (1, 1)
// its bottom right one; y is up. Unturned, its middle lies towards −Z and what is right of it
// towards +X; `rotation` turns it about Y [rad], counter-clockwise as seen from above.
SHARED_FUNCTION vec2 skyCoordinates(vec3 d, float rotation) {
  const float kInversePi = 0.318309886f;
  float u = 0.5f * kInversePi * (atan(d.x, -d.z) + rotation) + 0.5f;
  return vec2(u - floor(u), kInversePi * acos(clamp(d.y, -1.0f, 1.0f)));
}

SHARED_END
#endif
