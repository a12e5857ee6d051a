// What texels see by rays, and how often their stored depths say something else.
#pragma once

#include "renderer/surface_depths/surface_depths.h"
#include "renderer/surface_depths/texel_tree.h"

namespace lamplighter {

// Whether anything but area lights is in the way of a ray. They do not block bounced light, so that
// they can move freely.
bool blocksBouncedLight(const RenderScene& scene, const RayCaster& rays, Ray ray);
// Whether nothing is between the texel and a point of a surface, but area lights: they block no
// bounced light, so that they can move freely. False below the texel.
bool seesByRay(const RenderScene& scene, const RayCaster& rays, const SurfaceTexel& texel,
               const vec3& point);

// Share of the visibility tests of a texel's links in which depths and rays disagree, from 0 to 1.
// Up to `most` tests, evenly spread over all of them, with a ray each. `linkError`: as in
// TexelLinks::restart(). The depths must be complete.
float queryErrorOf(uint32_t texel, const RenderScene& scene, const RayCaster& rays,
                   const TexelSet& texels, const TexelTree& tree, const SurfaceDepths& depths,
                   float linkError, size_t most);

}  // namespace lamplighter
