// Visibility of texels by rays. Area lights block no bounced light, so that they can move freely.
#pragma once

#include "renderer/raycast/ray_caster.h"
#include "renderer/texels/texel_set.h"

namespace lamplighter {

// Whether anything except area lights blocks a ray.
bool blocksBouncedLight(const RenderScene& scene, const RayCaster& rays, Ray ray);
// Whether nothing blocks the line between the texel and a point of a surface (world space). False
// below the horizon of the texel.
bool seesByRay(const RenderScene& scene, const RayCaster& rays, const SurfaceTexel& texel,
               const vec3& point);

}  // namespace lamplighter
