// Adds light map coordinates to the meshes of a scene.
#pragma once

#include "renderer/bake/atlas.h"

namespace lamplighter {

// Returns a copy in which each node with light maps has its own mesh. The second UV set of that
// mesh is the position on the page in [0, 1]², with (0, 0) at the upper left as in glTF. Vertices
// shared by several charts are duplicated. The mesh name gets the suffix " (light map N)" with N
// the page. `render` must be made from `scene`. Throws InputError if a material already uses the
// second UV set.
Scene withLightMapUvs(const Scene& scene, const RenderScene& render, const LightMapAtlas& atlas);

}  // namespace lamplighter
