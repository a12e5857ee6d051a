// What lies under the pointer.
#pragma once

#include <functional>

#include "editor/document/document.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Half the width of the mark that stands for a light without a surface, in pixels.
inline constexpr float kMarkRadius = 9.0f;

// The node under a viewport pixel: a mark of a punctual light that nothing hides, else the surface
// that the pixel's ray meets; kNoNode where there is neither. What may not be picked is seen
// through.
NodeId pick(const View& view, const RenderScene& scene, const RayCaster& rays, const vec2& pointer,
            const std::function<bool(NodeId)>& mayPick);

}  // namespace lamplighter
