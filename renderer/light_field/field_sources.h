// What is sent along the light field without a bounce: by the sky, by area lights, and by surfaces
// that emit.
#pragma once

#include <vector>

#include "renderer/light_field/field_partners.h"
#include "renderer/sampling/emitters/lights.h"

namespace lamplighter {

// The sky without its suns, from a direction [W/(m² sr)].
vec3 skyRadiance(const LightSet& lights, const vec3& towards);
// Its mean over the part of the sphere of each direction; then over those of the opposite ends.
std::vector<vec4> skyOf(const LightSet& lights, const FieldDirections& directions);

// By PartnerNumbers [W/(m² sr)]: nothing from texels, unless they emit and the surface has lamps.
std::vector<vec4> fieldSources(const RenderScene& scene, const LightSet& lights,
                               const TexelSet& texels, const FieldSurface& surface, bool withLamps,
                               const FieldDirections& directions);

}  // namespace lamplighter
