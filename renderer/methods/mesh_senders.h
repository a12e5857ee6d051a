// Where the bounced light of a point comes from, with light on elements (renderer/surface_light).
#pragma once

#include "renderer/methods/inspection.h"
#include "renderer/surface_light/surface_light.h"

namespace lamplighter {

// The contributions to the light of the mesh at a point, by element, without the light of the sky.
// The light of records at pixels differs slightly. Empty where no light is stored.
std::vector<InspectedLink> meshSendersTo(const RenderScene& scene, const SurfaceLight& light,
                                         const InspectedPlace& place);

}  // namespace lamplighter
