#include "renderer/surface_depths/depth_intervals.h"

#include <algorithm>

namespace lamplighter {
namespace {

constexpr uint16_t kOpen = 0xffffu;

// A value in the middle has the largest tolerance on both sides. The value for open directions
// differs from all depths.
uint16_t valueOf(const DepthInterval& i) {
  return i.least == kOpen ? kOpen : static_cast<uint16_t>(i.least + (i.most - i.least) / 2);
}

}  // namespace

void compress(std::span<const DepthInterval> intervals, DepthSegments& out) {
  DepthInterval common;
  for (size_t t = 0; t < intervals.size(); ++t) {
    const DepthInterval next{std::max(common.least, intervals[t].least),
                             std::min(common.most, intervals[t].most)};
    if (next.least <= next.most) {
      common = next;
      continue;
    }
    out.values.push_back(valueOf(common));
    out.last.push_back(static_cast<uint8_t>(t - 1));
    common = intervals[t];
  }
  if (intervals.empty()) return;
  out.values.push_back(valueOf(common));
  out.last.push_back(static_cast<uint8_t>(intervals.size() - 1));
}

}  // namespace lamplighter
