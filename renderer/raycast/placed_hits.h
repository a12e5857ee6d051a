// Hits that are computed from the triangle that Embree found, in IEEE arithmetic (triangle_hit.h).
#pragma once

#include <embree3/rtcore.h>

#include "renderer/raycast/ray_caster.h"

namespace lamplighter {

// The hit of the ray with a triangle that Embree found.
Hit placed(const RenderScene& scene, const Ray& ray, uint32_t object, uint32_t triangle);

// placed() for eight lanes; the values of lanes without a hit are undefined.
struct PlacedLanes {
  alignas(32) float t[8], u[8], v[8];
};
// `tFar`: by lane, as it was before Embree overwrote it.
void placeLanes(const RenderScene& scene, const RTCRayHit8& r, const float* tFar, PlacedLanes& out);

}  // namespace lamplighter
