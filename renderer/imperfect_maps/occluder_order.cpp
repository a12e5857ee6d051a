#include "renderer/imperfect_maps/occluder_order.h"

#include <algorithm>

#include <tbb/parallel_sort.h>

#include "renderer/base/morton.h"

namespace lamplighter {
namespace {

constexpr float kLargestSizeRatio = 4.0f, kLargestGroupRatio = 6.0f;

struct OrderedTriangle {
  uint64_t key;
  uint32_t triangle;
  bool operator<(const OrderedTriangle& o) const {
    return key != o.key ? key < o.key : triangle < o.triangle;
  }
};

}  // namespace

OccluderOrder occluderOrderOf(std::span<const vec3> positions, std::span<const uint32_t> indices) {
  OccluderOrder order;
  const auto count = static_cast<uint32_t>(indices.size() / 3);
  const auto boxOf = [&](uint32_t t) {
    Bounds box;
    for (uint32_t i = 3 * t; i < 3 * t + 3; ++i) box.add(positions[indices[i]]);
    return box;
  };
  Bounds all;
  for (uint32_t t = 0; t < count; ++t) all.add(boxOf(t).centre());
  const vec3 extent = all.extent();
  const float largest = std::max({extent.x, extent.y, extent.z});
  const float cells = static_cast<float>((1u << kMortonBits) - 1);
  std::vector<OrderedTriangle> sorted(count);
  for (uint32_t t = 0; t < count; ++t) {
    const vec3 at = (boxOf(t).centre() - all.min) / largest * cells;
    uint64_t key = 0;
    // The comparison also holds for a mesh without extent, where `at` is not a number.
    for (int axis = 0; axis < 3; ++axis)
      if (at[axis] > 0.0f)
        key |= withTwoGaps(static_cast<uint64_t>(std::min(at[axis], cells))) << axis;
    sorted[t] = {key, t};
  }
  tbb::parallel_sort(sorted.begin(), sorted.end());

  order.triangles.reserve(count);
  Bounds group;
  float small = 0.0f, large = 0.0f;  // diagonals of triangles of the group
  uint32_t first = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t t = sorted[i].triangle;
    const Bounds box = boxOf(t);
    const float size = box.radius();
    Bounds with = group;
    with.add(box);
    const float newSmall = std::min(small, size), newLarge = std::max(large, size);
    if (i > first &&
        (i - first == kOccluderGroupTriangles || newLarge > kLargestSizeRatio * newSmall ||
         with.radius() > kLargestGroupRatio * newLarge)) {
      order.ends.push_back(i);
      first = i;
    }
    group = i == first ? box : with;
    small = i == first ? size : newSmall;
    large = i == first ? size : newLarge;
    order.triangles.push_back(t);
  }
  if (count > 0) order.ends.push_back(count);
  return order;
}

}  // namespace lamplighter
