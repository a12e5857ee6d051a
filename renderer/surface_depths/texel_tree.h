// A binary tree over the texels of all surfaces, for senders of light (paper 3, section 4.2).
// Divided by the way texels face, then at planes of a grid that halves its cells (Lauterbach et al.
// 2009, "Fast BVH construction on GPUs"), not by median cuts as in the paper: planes stay where
// they are when an object moves, so nodes without one of its texels stay the same.
//
// Nodes are in depth-first order: the first child of a node is the next one, and `skip` is the next
// one that is not below it.
#pragma once

#include <compare>
#include <vector>

#include "renderer/texels/texel_set.h"

namespace lamplighter {

class TexelTree {
 public:
  struct Node {
    vec3 centre{0.0f};
    float radius = 0.0f;  // of a sphere around all squares of its texels
    vec3 normal{0.0f};    // mean by area; not unit
    float area = 0.0f;
    float cosCone = 1.0f;  // of the largest angle between the direction of `normal` and a texel's
    uint32_t skip = 0;
    uint32_t firstTexel = 0, texels = 0;  // in order()

    bool isLeaf() const { return texels == 1; }
  };

  TexelTree() = default;
  explicit TexelTree(const TexelSet& texels);

  size_t size() const { return nodes_.size(); }
  size_t bytes() const { return nodes_.size() * sizeof(Node) + order_.size() * sizeof(uint32_t); }
  const Node& operator[](uint32_t node) const { return nodes_[node]; }
  // Texels by leaf.
  const std::vector<uint32_t>& order() const { return order_; }
  uint32_t texelOf(const Node& leaf) const { return order_[leaf.firstTexel]; }

  // Means by area of values of texels, by node.
  void pull(const std::vector<vec3>& byTexel, std::vector<vec3>& byNode) const;

 private:
  struct Key {
    uint32_t facing = 0;  // the axis to which a texel faces most, and its sign
    uint64_t cell = 0;    // bits of the cell along x, y and z in turn
    auto operator<=>(const Key&) const = default;
  };
  static Key keyOf(const SurfaceTexel& texel);
  uint32_t build(const TexelSet& texels, const std::vector<Key>& keys, uint32_t first,
                 uint32_t count);

  std::vector<Node> nodes_;
  std::vector<uint32_t> order_;
};

}  // namespace lamplighter
