// Where the links of a texel end in the tree: at nodes whose form factor is small, or at texels.
#pragma once

#include "renderer/surface_depths/texel_tree.h"

namespace lamplighter {

// At least the form factor of every part of the node, together: the bound of Lightcuts (Walter et
// al. 2005) with a sphere and a cone of normals.
float largestFormFactor(const SurfaceSpot& spot, const TexelTree::Node& node);

// Calls visit(node) for each node at which a link may end, by ascending nodes. `error`: nodes whose
// form factor may be larger are refined.
template <typename Visit>
void forEachEnd(const SurfaceSpot& spot, const TexelTree& tree, float error, const Visit& visit) {
  for (uint32_t n = 0; n < tree.size();) {
    const TexelTree::Node& node = tree[n];
    const float largest = largestFormFactor(spot, node);
    if (!node.isLeaf() && largest > error) {
      ++n;
      continue;
    }
    if (largest > 0.0f) visit(n);
    n = node.skip;
  }
}

}  // namespace lamplighter
