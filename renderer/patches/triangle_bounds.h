// Boxes around some triangles of an object: what moves gets all of its own anew in each frame.
#pragma once

#include <span>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Triangles are counted from the object's first; world space [m].
Bounds boundsOf(const RenderScene& scene, const RenderObject& object,
                std::span<const uint32_t> triangles);

}  // namespace lamplighter
