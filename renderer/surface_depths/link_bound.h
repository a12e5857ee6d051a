// How much light a texel may receive from a node: where links end in the tree.
#pragma once

#include "renderer/surface_depths/texel_tree.h"

namespace lamplighter {

// At least the form factor of every part of the node, together: the bound of Lightcuts (Walter et
// al. 2005) with a sphere and a cone of normals.
float largestFormFactor(const SurfaceSpot& spot, const TexelTree::Node& node);

}  // namespace lamplighter
