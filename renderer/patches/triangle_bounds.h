// Bounding boxes of triangles of an object. They are recomputed in each frame for objects that
// move.
#pragma once

#include <span>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Triangle indices are relative to the object. The result is in world space [m].
Bounds boundsOf(const RenderScene& scene, const RenderObject& object,
                std::span<const uint32_t> triangles);

}  // namespace lamplighter
