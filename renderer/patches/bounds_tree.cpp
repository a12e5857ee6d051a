#include "renderer/patches/bounds_tree.h"

namespace lamplighter {
namespace {

constexpr uint32_t kLeafBoxes = 4;

}  // namespace

BoundsTree::BoundsTree(std::span<const Bounds> boxes) {
  if (boxes.empty()) return;
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(boxes.size());
  nodes_.push_back({{}, 0, static_cast<uint32_t>(boxes.size())});
  split(0, boxes);
}

// Splits at the median of the centres along the longest axis. The depth is logarithmic, so the
// stack of visit() is large enough.
void BoundsTree::split(uint32_t index, std::span<const Bounds> boxes) {
  const uint32_t first = nodes_[index].first, count = nodes_[index].count;
  Bounds all, middles;
  for (uint32_t i = first; i < first + count; ++i) {
    all.add(boxes[order_[i]]);
    middles.add(boxes[order_[i]].centre());
  }
  nodes_[index].bounds = all;
  const vec3 size = middles.extent();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  if (count <= kLeafBoxes) return;
  const auto begin = order_.begin() + first, middle = begin + count / 2;
  std::nth_element(begin, middle, begin + count, [&](uint32_t a, uint32_t b) {
    const float ca = boxes[a].centre()[axis], cb = boxes[b].centre()[axis];
    return ca != cb ? ca < cb : a < b;
  });
  const auto children = static_cast<uint32_t>(nodes_.size());
  nodes_[index].first = children;
  nodes_[index].count = 0;
  nodes_.push_back({{}, first, count / 2});
  nodes_.push_back({{}, first + count / 2, count - count / 2});
  split(children, boxes);
  split(children + 1, boxes);
}

// Children follow their parents.
void BoundsTree::refit(std::span<const Bounds> boxes) {
  for (size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    node.bounds = Bounds();
    if (node.count == 0) {
      node.bounds.add(nodes_[node.first].bounds);
      node.bounds.add(nodes_[node.first + 1].bounds);
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i)
      node.bounds.add(boxes[order_[i]]);
  }
}

}  // namespace lamplighter
