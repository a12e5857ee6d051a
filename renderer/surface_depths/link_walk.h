// Traversal of the texel tree that finds the nodes that may light a point of a surface: for stored
// links, and for light that is gathered once.
#pragma once

#include <algorithm>

#include "renderer/surface_depths/texel_links.h"

namespace lamplighter {

// Upper bound of the form factor of a node: the bound of Lightcuts (Walter et al. 2005) with a
// sphere and a cone of normals.
float largestFormFactor(const SurfaceSpot& spot, const TexelTree::Node& node);

// Calls visit(node) for each node at which a link may end, in ascending order. `error`: nodes whose
// form factor may be larger are replaced by their children.
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

// Calls test(texel) for up to four texels of a node; their mean visibility is used for all of its
// texels.
template <typename Test>
void forEachTested(const TexelTree& tree, const TexelTree::Node& node, const Test& test) {
  constexpr uint32_t kMostTested = 4;
  const uint32_t tested = std::min(node.texels, kMostTested);
  for (uint32_t k = 0; k < tested; ++k)
    test(tree.order()[node.firstTexel + (2 * k + 1) * node.texels / (2 * tested)]);
}

// Calls visit(node, factor) for each node that may light a spot, in ascending order, with its form
// factor without occlusion. `own`: the texel of the spot, which does not light itself, or
// TexelSet::kNone. `error`: nodes whose form factor may be larger are replaced by their children.
template <typename Visit>
void walkLinks(const SurfaceSpot& spot, uint32_t own, const TexelSet& texels, const TexelTree& tree,
               float error, const Visit& visit) {
  forEachEnd(spot, tree, error, [&](uint32_t n) {
    const TexelTree::Node& node = tree[n];
    if (node.isLeaf() && tree.texelOf(node) == own) return;
    const float factor = formFactorOf(spot, texels, tree, node);
    if (factor > 0.0f) visit(n, factor);
  });
}

}  // namespace lamplighter
