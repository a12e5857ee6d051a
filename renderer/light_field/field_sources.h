// Light that enters the light field without a bounce: from the sky, area lights and emissive
// surfaces.
#pragma once

#include <vector>

#include "renderer/light_field/field_partners.h"
#include "renderer/sampling/emitters/lights.h"

namespace lamplighter {

// Radiance of the sky without suns in a direction [W/(m² sr)].
vec3 skyRadiance(const LightSet& lights, const vec3& towards);
// Mean of this radiance over the part of the sphere of each direction, followed by those of the
// opposite ends.
std::vector<vec4> skyOf(const LightSet& lights, const FieldDirections& directions);

// By PartnerNumbers [W/(m² sr)]. Texels send nothing, unless they emit and `withLamps` is set.
std::vector<vec4> fieldSources(const RenderScene& scene, const LightSet& lights,
                               const TexelSet& texels, const FieldSurface& surface, bool withLamps,
                               const FieldDirections& directions);

}  // namespace lamplighter
