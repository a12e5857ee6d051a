// A binary tree over the texels of all surfaces as senders of light (paper 3, section 4.2). It is
// divided by the main axis of the normals, then at planes of a grid whose cells are halved
// (Lauterbach et al. 2009, "Fast BVH construction on GPUs"), not by median cuts as in the paper:
// the planes do not depend on the texels, so nodes without a texel of a moved object do not change.
//
// Nodes are in depth-first order: the first child of a node is the next one, and `skip` is the next
// node outside its subtree.
#pragma once

#include <compare>
#include <vector>

#include "renderer/texels/texel_set.h"

namespace lamplighter {

class TexelTree {
 public:
  struct Node {
    vec3 centre{0.0f};
    float radius = 0.0f;  // of a bounding sphere of the squares of its texels
    vec3 normal{0.0f};    // mean weighted by area; not normalised
    float area = 0.0f;
    float cosCone = 1.0f;  // cosine of the largest angle between `normal` and the normal of a texel
    uint32_t skip = 0;
    uint32_t firstTexel = 0, texels = 0;  // indices into order()

    bool isLeaf() const { return texels == 1; }
  };

  TexelTree() = default;
  explicit TexelTree(const TexelSet& texels);

  size_t size() const { return nodes_.size(); }
  size_t bytes() const { return nodes_.size() * sizeof(Node) + order_.size() * sizeof(uint32_t); }
  const Node& operator[](uint32_t node) const { return nodes_[node]; }
  // Texels in the order of the leaves.
  const std::vector<uint32_t>& order() const { return order_; }
  uint32_t texelOf(const Node& leaf) const { return order_[leaf.firstTexel]; }

  // Computes for each node the mean of the values of its texels, weighted by area.
  void pull(const std::vector<vec3>& byTexel, std::vector<vec3>& byNode) const;

 private:
  struct Key {
    uint32_t facing = 0;  // axis and sign of the largest component of the normal
    uint64_t cell = 0;    // Morton code: bits of the cell along x, y and z in turn
    auto operator<=>(const Key&) const = default;
  };
  static Key keyOf(const SurfaceTexel& texel);
  uint32_t build(const TexelSet& texels, const std::vector<Key>& keys, uint32_t first,
                 uint32_t count);

  std::vector<Node> nodes_;
  std::vector<uint32_t> order_;
};

}  // namespace lamplighter
