// Compression of a sequence of depths that may each be any value of an interval (paper 3, section
// 3.2; Weiskopf and Ertl, "Shadow Mapping Based on Dual Depth Layers", 2003).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lamplighter {

// Stored values that answer every visibility query correctly: at least the depth of the first
// surface, which is visible, and less than that of the second one, which is not.
struct DepthInterval {
  uint16_t least = 0, most = 0xffffu;
};

// Segments of equal values of consecutive texels.
struct DepthSegments {
  std::vector<uint16_t> values;
  std::vector<uint8_t> last;  // by segment: its last texel, as an index into the run
};
// Maximum number of texels of a run.
inline constexpr size_t kMostInRun = 256;

// Appends the fewest segments such that each value lies in the intervals of its texels: consecutive
// intervals are intersected until the intersection is empty. At most kMostInRun intervals.
void compress(std::span<const DepthInterval> intervals, DepthSegments& out);

}  // namespace lamplighter
