#include "renderer/surface_depths/texel_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lamplighter {
namespace {

// The axis that is most similar to the normal: texels of one node should face one way, so that the
// mean of their normals tells how much light they send.
int facingOf(const SurfaceTexel& texel) {
  const vec3& n = texel.spot.geometricNormal;
  const vec3 size = glm::abs(n);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return 2 * axis + (n[axis] < 0.0f ? 1 : 0);
}

}  // namespace

TexelTree::TexelTree(const TexelSet& texels) : order_(texels.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  std::ranges::stable_sort(order_, {}, [&](uint32_t t) { return facingOf(texels[t]); });
  nodes_.reserve(2 * texels.size());
  if (texels.size() > 0) build(texels, 0, static_cast<uint32_t>(texels.size()));
}

// Returns the number of the node of these texels of order_.
uint32_t TexelTree::build(const TexelSet& texels, uint32_t first, uint32_t count) {
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
    const auto begin = order_.begin() + first;
    uint32_t half = count / 2;
    const int facing = facingOf(texels[order_[first + half]]);
    if (facingOf(texels[order_[first]]) != facingOf(texels[order_[first + count - 1]])) {
      // Where another direction begins, next to the middle.
      const auto isBefore = [&](uint32_t t, int f) { return facingOf(texels[t]) < f; };
      half =
          static_cast<uint32_t>(std::lower_bound(begin, begin + count, facing, isBefore) - begin);
      if (half == 0)
        half = static_cast<uint32_t>(std::lower_bound(begin, begin + count, facing + 1, isBefore) -
                                     begin);
    } else {
      const vec3 extent = bounds.extent();
      const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                       : extent.y >= extent.z                       ? 1
                                                                    : 2;
      std::sort(begin, begin + count, [&](uint32_t a, uint32_t b) {
        return std::pair(texels[a].spot.position[axis], a) <
               std::pair(texels[b].spot.position[axis], b);
      });
    }
    build(texels, first, half);
    build(texels, first + half, count - half);
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
