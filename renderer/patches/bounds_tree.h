// A binary tree (BVH) over boxes. A pyramid search visits only the boxes near it, not the whole
// scene.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter {

class BoundsTree {
 public:
  BoundsTree() = default;
  explicit BoundsTree(std::span<const Bounds> boxes);

  // Updates the boxes and keeps the structure of the tree.
  void refit(std::span<const Bounds> boxes);
  size_t size() const { return order_.size(); }
  Bounds bounds() const { return nodes_.empty() ? Bounds() : nodes_[0].bounds; }

  // Visits each subtree for which enter(bounds) returns true and calls take(i) for each of its
  // boxes i. Stops when take() returns false. Returns whether the traversal was complete.
  template <typename Enter, typename Take>
  bool visit(const Enter& enter, const Take& take) const {
    if (nodes_.empty()) return true;
    uint32_t stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& node = nodes_[stack[--top]];
      if (!enter(node.bounds)) continue;
      if (node.count > 0) {
        for (uint32_t i = node.first; i < node.first + node.count; ++i)
          if (!take(order_[i])) return false;
      } else {
        stack[top++] = node.first + 1;
        stack[top++] = node.first;
      }
    }
    return true;
  }

  // The same for many searches in one traversal. narrow(bounds) restricts the active searches to
  // those that enter the subtree and returns whether any remain; widen() is called when the subtree
  // is left.
  template <typename Narrow, typename Take, typename Widen>
  void descend(const Narrow& narrow, const Take& take, const Widen& widen) const {
    if (!nodes_.empty()) descend(0, narrow, take, widen);
  }

 private:
  struct Node {
    Bounds bounds;
    uint32_t first = 0, count = 0;  // leaf: range in order_; inner node: count 0, `first` is the
                                    // first of two children
  };
  void split(uint32_t node, std::span<const Bounds> boxes);
  template <typename Narrow, typename Take, typename Widen>
  void descend(uint32_t index, const Narrow& narrow, const Take& take, const Widen& widen) const {
    const Node& node = nodes_[index];
    if (narrow(node.bounds)) {
      if (node.count == 0) {
        descend(node.first, narrow, take, widen);
        descend(node.first + 1, narrow, take, widen);
      }
      for (uint32_t i = node.first; i < node.first + node.count; ++i) take(order_[i]);
    }
    widen();
  }

  std::vector<Node> nodes_;
  std::vector<uint32_t> order_;
};

}  // namespace lamplighter
