// Computes normals for triangles whose file has none.
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace lamplighter {

// Gives each vertex marked in `missing` (one entry per position) the normal of its face. A vertex
// shared by faces with different normals is split, with all its attributes.
void addFlatNormals(Primitive& primitive, const std::vector<bool>& missing);

}  // namespace lamplighter
