// The surfaces of area lights as triangles, so that everything downstream knows one kind of
// emitter.
#pragma once

#include "renderer/scene/scene.h"

namespace lamplighter {

// In the node's space, front faces towards −Z (a sphere: outwards). A disk is a regular polygon and
// a sphere an icosphere, both of exactly the true shape's area, so that flux is exact and only the
// outline is an approximation. The count of triangles depends on the shape alone.
Primitive tessellate(const AreaLight& light);

}  // namespace lamplighter
