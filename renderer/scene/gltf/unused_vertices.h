// Removes vertices that no triangle uses.
#pragma once

#include "renderer/scene/scene.h"

namespace lamplighter {

// Removes unused vertices if they are the majority. Some exporters share one vertex list between
// all primitives of a level, which would otherwise be copied for each primitive.
void dropUnusedVertices(Primitive& primitive);

}  // namespace lamplighter
