// The order of cells along a Z-shaped curve: neighbours on the curve are close in space
// (Morton 1966).
#pragma once

#include <cstdint>

namespace lamplighter {

inline constexpr int kMortonBits = 21;  // per axis

// Moves bit i of a number of kMortonBits bits to bit 3i.
inline uint64_t withTwoGaps(uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffffull;
  x = (x | x << 16) & 0x001f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

}  // namespace lamplighter
