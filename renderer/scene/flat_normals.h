// Normals for triangles whose file has none.
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace lamplighter {

// Gives the vertices marked in `missing` (as many as positions) the normal of their face. A vertex
// that several faces share is split where they face different ways; all attributes follow.
void addFlatNormals(Primitive& primitive, const std::vector<bool>& missing);

}  // namespace lamplighter
