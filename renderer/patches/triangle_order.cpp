#include "renderer/patches/triangle_order.h"

#include <algorithm>
#include <bit>
#include <span>

#include <tbb/parallel_invoke.h>

namespace lamplighter {
namespace {

constexpr size_t kClusterTriangles = 1024;  // larger clusters are halved
// Smaller ranges are not worth a task of their own.
constexpr size_t kTaskTriangles = 4096;

struct Item {
  vec3 middle;  // three times the centre
  uint32_t triangle;
  Bounds box;
};

// An integer with the order of the float.
uint32_t orderOf(float v) {
  const auto bits = std::bit_cast<uint32_t>(v + 0.0f);  // -0 becomes +0
  return (bits >> 31) != 0 ? ~bits : bits | 0x80000000u;
}

// The left half consists of whole groups, so that no group is split.
size_t leftHalf(size_t count) {
  return (count / 2 + kGroupTriangles - 1) / kGroupTriangles * kGroupTriangles;
}

// Nodes are numbered like those of a complete binary tree: the children of n are 2n and 2n + 1.
class Sorting {
 public:
  Sorting(size_t items, float smallest) : smallest_(smallest) {
    size_t nodes = 2;
    for (size_t count = items; count > kClusterTriangles; count = leftHalf(count)) nodes *= 2;
    isHalved_.resize(nodes, 0);
  }

  // Sorts the items of a node. mayHalve: the node is a cluster.
  void sort(size_t node, std::span<Item> items, bool mayHalve) {
    if (items.size() <= kGroupTriangles) return;
    Bounds box;
    for (const Item& i : items) box.add(i.box);
    const vec3 size = box.extent();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const bool halves = mayHalve && items.size() > kClusterTriangles && size[axis] > smallest_;
    if (halves) isHalved_[node] = 1;
    sortAlong(axis, items);
    const auto left = items.first(leftHalf(items.size())), right = items.subspan(left.size());
    const auto sortLeft = [&] { sort(2 * node, left, halves); };
    const auto sortRight = [&] { sort(2 * node + 1, right, halves); };
    if (items.size() > kTaskTriangles) {
      tbb::parallel_invoke(sortLeft, sortRight);
    } else {
      sortLeft();
      sortRight();
    }
  }

  // Adds the clusters below `cluster`, which is this node.
  void addClusters(size_t node, size_t cluster, std::vector<ClusterTopology>& out) const {
    if (node >= isHalved_.size() || isHalved_[node] == 0) return;
    const uint32_t first = out[cluster].first, count = out[cluster].count;
    const auto half = static_cast<uint32_t>(leftHalf(count));
    const size_t children = out.size();
    out[cluster].firstChild = static_cast<int>(children);
    out.push_back({first, half, kNone});
    out.push_back({first + half, count - half, kNone});
    addClusters(2 * node, children, out);
    addClusters(2 * node + 1, children + 1, out);
  }

 private:
  // A stable sort.
  static void sortAlong(int axis, std::span<Item> items) {
    std::vector<uint64_t> order(items.size());
    for (size_t i = 0; i < items.size(); ++i)
      order[i] = uint64_t{orderOf(items[i].middle[axis])} << 32 | i;
    std::sort(order.begin(), order.end());
    std::vector<Item> sorted;
    sorted.reserve(items.size());
    for (const uint64_t o : order) sorted.push_back(items[static_cast<uint32_t>(o)]);
    std::copy(sorted.begin(), sorted.end(), items.begin());
  }

  float smallest_;
  std::vector<uint8_t> isHalved_;  // by node
};

}  // namespace

void sortLoose(const MeshShape& shape, float smallest, MeshTopology& out) {
  if (out.loose.empty()) return;
  std::vector<Item> items;
  items.reserve(out.loose.size());
  for (const uint32_t t : out.loose)
    items.push_back({shape.at(t, 0) + shape.at(t, 1) + shape.at(t, 2), t, shape.boundsOf(t)});
  Sorting sorting(items.size(), smallest);
  sorting.sort(1, items, true);
  for (size_t i = 0; i < items.size(); ++i) out.loose[i] = items[i].triangle;
  out.clusters.push_back({0, static_cast<uint32_t>(items.size()), kNone});
  sorting.addClusters(1, 0, out.clusters);
}

void addOccluders(const MeshShape& shape, MeshTopology& out) {
  std::vector<Bounds> boxes;
  for (const ChartTopology& chart : out.charts) {
    for (const uint32_t t : chart.triangles) {
      out.flat.push_back(t);
      boxes.push_back(shape.boundsOf(t));
    }
  }
  for (size_t i = 0; i < out.loose.size(); ++i) {
    if (i % kGroupTriangles == 0) boxes.emplace_back();
    boxes.back().add(shape.boundsOf(out.loose[i]));
  }
  out.occluders = BoundsTree(boxes);
}

}  // namespace lamplighter
