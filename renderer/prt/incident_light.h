// The light of one VPL that arrives at a point near a complex object (paper 1, 4.4.1): its
// direction, its irradiance, and whether something other than the object blocks it.
#pragma once

#include <optional>

#include "renderer/raycast/ray_caster.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

struct IncidentLight {
  vec3 direction{0.0f};   // unit vector to the light, world space
  vec3 irradiance{0.0f};  // on a plane that faces the light [W/m²]
  float distance = 0.0f;  // to the light [m]; infinite for a directional light
};

// None if the VPL emits nothing towards the point. Same formulas as vplGeometry() of vpl_shading.h
// without the receiver's cosine. The irradiance is clamped to 2¹⁶ W/m², so that sums stay exact
// (prt_lights.h).
std::optional<IncidentLight> incidentLight(const shared::Vpl& vpl, const vec3& point,
                                           float clampDistance);

// Whether anything except `object` blocks the light. The shadows of the object on itself are part
// of its transfer, so the ray continues through its hits on the object.
bool isHiddenByOthers(const RayCaster& rays, uint32_t object, const vec3& point,
                      const IncidentLight& light);

// Whether a VPL on a surface lies on the object. Its light on the object is part of the object's
// transfer, as interreflection.
bool liesOn(const RayCaster& rays, uint32_t object, const shared::Vpl& vpl);

}  // namespace lamplighter
