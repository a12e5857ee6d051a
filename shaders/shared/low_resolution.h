// The low-resolution pass (paper 1, 4.3.3): light is summed at one pixel of each block and
// interpolated between, but where the picture has an edge. The definition that both backends follow.
//
// Samples are the pixels (min(B·i, width − 1), min(B·j, height − 1)). Four neighbouring ones are the
// corners of a cell, which takes its pixels' irradiance from theirs, bilinearly, when
//   - all pixels from corner to corner, the far rows among them, hit a surface, and lie in the plane
//     of the first corner with about its shading normal. The whole cell is asked, so that no light
//     leaks past what is thinner than a block;
//   - the same lights leave out what all of these pixels show (renderer/scene/light_linking.h);
//   - the irradiance at its corners differs little: the borders of shadows stay where they are;
//   - it does not differ much in any of the eight cells about it: the border of a shadow may come
//     into this cell without reaching a corner. Where no light makes hard shadows, only corners of
//     one surface are compared, as each surface has its own light;
//   - none of the few lights that make hard shadows is partly hidden from the patch of a corner
//     (renderer/backends/cpu/irradiance/irradiance_accumulator.h): what they light may be narrower than a block.
// The pixels of all other cells are summed one by one.
//
// In haste (ShadingParams::block.y), while the camera moves, samples are pixels of a smaller picture
// that is made likewise, with blocks of kSampleBlock.
#ifndef LAMPLIGHTER_SHARED_LOW_RESOLUTION_H
#define LAMPLIGHTER_SHARED_LOW_RESOLUTION_H
#include "interop.h"

SHARED_BEGIN

// Share of the distance between two points by which one may be off the other's plane.
SHARED_CONST float kMostOffPlane = 0.01f;
// Cosine of the angle between the shading normals of two points of a cell.
SHARED_CONST float kLeastNormalCosine = 0.999f;
// Share of the brightest corner by which the irradiance of a cell's corners may differ.
SHARED_CONST float kMostContrast = 0.2f;
// The same in the cells about it.
SHARED_CONST float kMostContrastAbout = 0.25f;

// Samples a side of the blocks of samples, in haste.
SHARED_CONST int kSampleBlock = 2;

// Samples along a side of `size` pixels.
SHARED_FUNCTION int lowResolutionSamples(int size, int block) {
  return (size - 1 + block - 1) / block + 1;
}

// Whether a point x with shading normal s lies on the surface at x0, with geometric normal n0 and
// shading normal s0; world space, unit normals.
SHARED_FUNCTION bool isOnSurface(vec3 x0, vec3 n0, vec3 s0, vec3 x, vec3 s) {
  vec3 d = x - x0;
  float off = dot(n0, d);
  return off * off <= kMostOffPlane * kMostOffPlane * dot(d, d) && dot(s0, s) >= kLeastNormalCosine;
}

// Whether the irradiance at four corners differs by no more than that share.
SHARED_FUNCTION bool isSmooth(vec3 a, vec3 b, vec3 c, vec3 d, float mostContrast) {
  vec3 most = max(max(a, b), max(c, d));
  vec3 spread = most - min(min(a, b), min(c, d));
  vec3 allowed = mostContrast * most;
  return spread.x <= allowed.x && spread.y <= allowed.y && spread.z <= allowed.z;
}

// Share of all light of its sort that a light has that makes hard shadows.
SHARED_CONST float kHardShare = 0.05f;

SHARED_END
#endif
