// Where the bounced light of a point comes from, with light on elements (renderer/surface_light).
#pragma once

#include "renderer/methods/inspection.h"
#include "renderer/surface_light/surface_light.h"

namespace lamplighter {

// By element, what the light of the mesh at a place is the sum of, without the light of the sky.
// Records at pixels differ a little. Empty where no light is kept.
std::vector<InspectedLink> meshSendersTo(const RenderScene& scene, const SurfaceLight& light,
                                         const InspectedPlace& place);

}  // namespace lamplighter
