// Finds the node under the pointer.
#pragma once

#include <functional>

#include "editor/document/document.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Half the width of the mark of a light without a surface, in pixels.
inline constexpr float kMarkRadius = 9.0f;

// The view is in the unit of the scene.
// The node under a viewport pixel: a visible mark of a punctual light, otherwise the surface that
// the pixel's ray hits; kNoNode if there is neither. Objects that cannot be picked are ignored.
NodeId pick(const View& view, const RenderScene& scene, const RayCaster& rays, const vec2& pointer,
            const std::function<bool(NodeId)>& mayPick);

}  // namespace lamplighter
