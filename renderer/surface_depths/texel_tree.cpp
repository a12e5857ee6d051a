#include "renderer/surface_depths/texel_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "renderer/base/morton.h"

namespace lamplighter {
namespace {

// The smallest cells of the grid [m], and their number along an axis: ±4 km.
constexpr float kCell = 1.0f / 256.0f;
constexpr float kCells = 1 << kMortonBits;

}  // namespace

TexelTree::Key TexelTree::keyOf(const SurfaceTexel& texel) {
  const vec3& n = texel.spot.geometricNormal;
  const vec3 size = glm::abs(n);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  Key key;
  key.facing = static_cast<uint32_t>(2 * axis + (n[axis] < 0.0f ? 1 : 0));
  for (int k = 0; k < 3; ++k) {
    const float cell = std::floor(texel.spot.position[k] / kCell) + 0.5f * kCells;
    key.cell |= withTwoGaps(static_cast<uint64_t>(std::clamp(cell, 0.0f, kCells - 1.0f)))
                << (2 - k);
  }
  return key;
}

TexelTree::TexelTree(const TexelSet& texels) : order_(texels.size()) {
  std::vector<std::pair<Key, uint32_t>> sorted(texels.size());
  for (uint32_t t = 0; t < texels.size(); ++t) sorted[t] = {keyOf(texels[t]), t};
  std::ranges::sort(sorted);
  std::vector<Key> keys;
  for (size_t i = 0; i < sorted.size(); ++i) {
    keys.push_back(sorted[i].first);
    order_[i] = sorted[i].second;
  }
  nodes_.reserve(2 * texels.size());
  if (texels.size() > 0) build(texels, keys, 0, static_cast<uint32_t>(texels.size()));
}

// Builds the node of these texels of order_ and returns its number. `keys`: in that order.
uint32_t TexelTree::build(const TexelSet& texels, const std::vector<Key>& keys, uint32_t first,
                          uint32_t count) {
  const auto number = static_cast<uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.firstTexel = first;
  node.texels = count;
  Bounds bounds;
  for (uint32_t i = first; i < first + count; ++i) {
    const SurfaceTexel& t = texels[order_[i]];
    bounds.add(t.spot.position);
    node.area += t.area;
    node.normal += t.area * t.spot.geometricNormal;
  }
  node.centre = bounds.centre();
  if (node.area > 0.0f) node.normal /= node.area;
  const float length = glm::length(node.normal);
  for (uint32_t i = first; i < first + count; ++i) {
    const SurfaceTexel& t = texels[order_[i]];
    node.radius = std::max(node.radius, glm::distance(t.spot.position, node.centre) +
                                            glm::length(t.half[0]) + glm::length(t.half[1]));
    node.cosCone =
        std::min(node.cosCone,
                 length > 0.0f ? glm::dot(node.normal, t.spot.geometricNormal) / length : -1.0f);
  }
  if (count > 1) {
    const Key &low = keys[first], &high = keys[first + count - 1];
    const auto begin = keys.begin() + first;
    uint32_t half = count / 2;
    if (low != high) {
      // Split where the highest differing bit becomes 1.
      Key plane = high;
      if (low.facing != high.facing) {
        const uint32_t bit = std::bit_floor(low.facing ^ high.facing);
        plane = {high.facing & ~(bit - 1), 0};
      } else {
        plane.cell &= ~(std::bit_floor(low.cell ^ high.cell) - 1);
      }
      half = static_cast<uint32_t>(std::lower_bound(begin, begin + count, plane) - begin);
    }
    build(texels, keys, first, half);
    build(texels, keys, first + half, count - half);
  }
  node.skip = static_cast<uint32_t>(nodes_.size());
  nodes_[number] = node;
  return number;
}

void TexelTree::pull(const std::vector<vec3>& byTexel, std::vector<vec3>& byNode) const {
  byNode.resize(nodes_.size());
  // Children come after their parents.
  for (size_t n = nodes_.size(); n-- > 0;) {
    const Node& node = nodes_[n];
    if (node.isLeaf()) {
      byNode[n] = byTexel[texelOf(node)];
      continue;
    }
    const uint32_t left = static_cast<uint32_t>(n) + 1, right = nodes_[left].skip;
    byNode[n] =
        node.area > 0.0f
            ? (nodes_[left].area * byNode[left] + nodes_[right].area * byNode[right]) / node.area
            : vec3(0.0f);
  }
}

}  // namespace lamplighter
