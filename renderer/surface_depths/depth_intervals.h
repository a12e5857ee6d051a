// Compression of a sequence of depths that may each be any value of an interval (paper 3, section
// 3.2; Weiskopf and Ertl, "Shadow Mapping Based on Dual Depth Layers", 2003).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lamplighter {

// Values that answer every query: from the first surface on, and less than the second. The depth
// of the first surface is seen, that of the second one is not.
struct DepthInterval {
  uint16_t least = 0, most = 0xffffu;
};

// Equal values of consecutive texels.
struct DepthSegments {
  std::vector<uint16_t> values;
  std::vector<uint8_t> last;  // texel of each, within the run
};
// A run has at most so many texels.
inline constexpr size_t kMostInRun = 256;

// Appends the fewest segments such that each value lies in the intervals of its texels: intervals
// are intersected until that is empty. At most kMostInRun intervals.
void compress(std::span<const DepthInterval> intervals, DepthSegments& out);

}  // namespace lamplighter
