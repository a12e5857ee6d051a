// The low-resolution pass (paper 1, 4.3.3): light is summed at one pixel per block and interpolated
// between these samples, except at edges of the picture. Both backends follow this definition.
//
// Samples are the pixels (min(B·i, width − 1), min(B·j, height − 1)). Four neighbouring samples are
// the corners of a cell. The irradiance of the cell's pixels is interpolated bilinearly from its
// corners if
//   - all pixels between the corners, including the far row and column, hit a surface and lie in
//     the plane of the first corner with nearly its shading normal (the whole cell is tested, so
//     that no light leaks past objects thinner than a block);
//   - light linking excludes the same lights for all these pixels (renderer/scene/light_linking.h);
//   - the irradiance at its corners is similar, so that shadow borders stay in place;
//   - it is also similar in the eight neighbouring cells, because a shadow border may enter this
//     cell without reaching a corner. Without hard-shadow lights, only corners on one surface are
//     compared, because each surface has its own light;
//   - no hard-shadow light is partly hidden from the patch of a corner
//     (renderer/backends/cpu/irradiance/irradiance_accumulator.h), because what it lights may be
//     narrower than a block.
// The pixels of all other cells are summed one by one.
//
// For quick pictures while the camera moves (ShadingParams::block.y), samples are pixels of a
// smaller picture, which is itself interpolated in the same way with blocks of kSampleBlock.
#ifndef LAMPLIGHTER_SHARED_LOW_RESOLUTION_H
#define LAMPLIGHTER_SHARED_LOW_RESOLUTION_H
#include "interop.h"

SHARED_BEGIN

// Largest distance of a point from the other's plane, as a share of the distance between the
// points.
SHARED_CONST float kMostOffPlane = 0.01f;
// Smallest cosine of the angle between the shading normals of two points of a cell.
SHARED_CONST float kLeastNormalCosine = 0.999f;
// Largest difference of irradiance between the corners of a cell, as a share of the brightest
// corner.
SHARED_CONST float kMostContrast = 0.2f;
// The same for the neighbouring cells.
SHARED_CONST float kMostContrastAbout = 0.25f;

// Samples per side of the blocks of samples, in quick pictures.
SHARED_CONST int kSampleBlock = 2;

// Number of samples along a side of `size` pixels.
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

// Whether the irradiance at four corners differs by at most this share of the brightest.
SHARED_FUNCTION bool isSmooth(vec3 a, vec3 b, vec3 c, vec3 d, float mostContrast) {
  vec3 most = max(max(a, b), max(c, d));
  vec3 spread = most - min(min(a, b), min(c, d));
  vec3 allowed = mostContrast * most;
  return spread.x <= allowed.x && spread.y <= allowed.y && spread.z <= allowed.z;
}

// A hard-shadow light has more than this share of the light of its kind.
SHARED_CONST float kHardShare = 0.05f;

SHARED_END
#endif
