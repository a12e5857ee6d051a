// Iterates over the set bits of a word.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace lamplighter {

// Calls f(i) for each set bit i, in ascending order.
template <typename F>
void forEachBit(uint64_t mask, const F& f) {
  for (; mask != 0; mask &= mask - 1) f(static_cast<size_t>(std::countr_zero(mask)));
}

}  // namespace lamplighter
