// Vertices that no triangle of a primitive uses.
#pragma once

#include "renderer/scene/scene.h"

namespace lamplighter {

// Takes them out where they are the greater part: some exporters give all primitives of a level one
// list of vertices, which would be laid out again for each of them.
void dropUnusedVertices(Primitive& primitive);

}  // namespace lamplighter
