// The bits of a word, one after the other.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace lamplighter {

// f(i) for each bit i that is set, in order.
template <typename F>
void forEachBit(uint64_t mask, const F& f) {
  for (; mask != 0; mask &= mask - 1) f(static_cast<size_t>(std::countr_zero(mask)));
}

}  // namespace lamplighter
