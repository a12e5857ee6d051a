// A scene whose meshes carry the places of their light maps.
#pragma once

#include "renderer/bake/atlas.h"

namespace lamplighter {

// A copy in which each node with light maps has a mesh of its own, its second UV set on the page
// [0, 1]², (0, 0) the upper left as in glTF; vertices between charts are doubled. The mesh's name
// ends in " (light map N)", N its page. `render`: of this scene. Throws InputError where a material
// uses the second UV set already.
Scene withLightMapUvs(const Scene& scene, const RenderScene& render, const LightMapAtlas& atlas);

}  // namespace lamplighter
