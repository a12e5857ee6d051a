// The octahedral hemisphere map (paper 1, 4.2.1, figure 4-4): the upper four faces of the
// octahedron |x| + |y| + z = 1, seen from above and rotated by 45° so that they fill the square
// [-1, 1]². On each face the projection is linear in homogeneous coordinates:
//   (s, t, w) = (x + y, x − y, |x| + |y| + z), and s/w, t/w lie in the square.
// The map stores 1/w [1/m] of the nearest occluder (0: none). For a plane, 1/w is linear over a
// face, so rasterisation interpolates it exactly. Nearer means larger, which keeps float precision.
// The creases x = 0 and y = 0 are the diagonals of the square and pass through texel centres; there
// |x| or |y| is zero, so both neighbouring faces give the same (s, t, w).
#ifndef LAMPLIGHTER_SHARED_OCTAHEDRAL_H
#define LAMPLIGHTER_SHARED_OCTAHEDRAL_H
#include "interop.h"

SHARED_BEGIN

// w: the L1 norm of a direction of the upper hemisphere, light space (z along the normal).
SHARED_FUNCTION float octahedralW(vec3 d) { return abs(d.x) + abs(d.y) + d.z; }

// Square coordinates in [-1, 1]² of a direction with d.z ≥ 0 and non-zero length.
SHARED_FUNCTION vec2 octahedralEncode(vec3 d) {
  return vec2(d.x + d.y, d.x - d.y) * (1.0f / octahedralW(d));
}

// The point with w = 1 (on the octahedron, not unit length) that maps to s in [-1, 1]².
SHARED_FUNCTION vec3 octahedralDecode(vec2 s) {
  float x = 0.5f * (s.x + s.y);
  float y = 0.5f * (s.x - s.y);
  return vec3(x, y, 1.0f - abs(x) - abs(y));
}

SHARED_END
#endif
