// Compares two scenes, ignoring ids and the order of siblings' subtrees.
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace lamplighter::test {

// Empty if the scenes are equal, otherwise a description of the first difference. The comparison is
// bit for bit: nodes by their position in the tree, meshes with all attributes, materials, cameras,
// texture pixels and wrap modes. It ignores ids, the source, and whether an image is a placeholder.
std::string difference(const Scene& a, const Scene& b);

}  // namespace lamplighter::test
