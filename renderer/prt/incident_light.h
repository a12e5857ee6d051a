// What of a VPL arrives at a point about a complex object (paper 1, 4.4.1): from where, how much,
// and whether anything but the object itself stands between.
#pragma once

#include <optional>

#include "renderer/raycast/ray_caster.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

struct IncidentLight {
  vec3 direction{0.0f};   // unit, to the light, world space
  vec3 irradiance{0.0f};  // of a plane that faces it [W/m²]
  float distance = 0.0f;  // to it; infinite: a directional one [m]
};

// None where the VPL sends nothing to. As vplGeometry() of vpl_shading.h, but for the receiver's
// cosine. Nothing is brighter than 2¹⁶ W/m², so that sums of light stay exact (prt_lights.h).
std::optional<IncidentLight> incidentLight(const shared::Vpl& vpl, const vec3& point,
                                           float clampDistance);

// Whether anything but `object` stands between: its own shadows are in its transfer. The ray goes
// on through what it hits of the object.
bool isHiddenByOthers(const RayCaster& rays, uint32_t object, const vec3& point,
                      const IncidentLight& light);

// Whether a VPL that stands for a surface lies on the object: what it gives to the object is in its
// transfer, as light between its parts.
bool liesOn(const RayCaster& rays, uint32_t object, const shared::Vpl& vpl);

}  // namespace lamplighter
