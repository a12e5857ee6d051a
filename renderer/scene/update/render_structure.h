// Updates a RenderScene for nodes that were added, removed, hidden or shown.
#pragma once

#include "renderer/scene/update/render_objects.h"

namespace lamplighter {

// Updates objects and materials for any change of the document, and adds the changes to `out`.
// Returns false if the scene must be rebuilt, and does nothing then: it has other materials,
// textures, light links or kinds of meshes, or objects in another order, or too many deleted ones.
bool takeStructure(RenderScene& render, const Scene& scene, const SceneState& state,
                   RenderSceneChanges& out);

}  // namespace lamplighter
