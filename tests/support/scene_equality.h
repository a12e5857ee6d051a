// Whether two scenes are the same level, whatever their ids and the order of siblings' subtrees.
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace lamplighter::test {

// Empty when they are the same; else the first difference, in words. Compared bit for bit: nodes by
// their place in the tree, meshes with all attributes, materials, cameras, texture pixels and wrap
// modes. Not compared: ids, source, whether a placeholder stands for an image.
std::string difference(const Scene& a, const Scene& b);

}  // namespace lamplighter::test
