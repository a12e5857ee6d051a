// How much memory light by transfer takes, and which objects get it where not all fit.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lamplighter {

// An object that is to have transfer.
struct PrtNeeds {
  size_t vertices = 0;
  size_t points = 0;       // light points
  size_t slots = 0;        // of lights
  bool isChecked = false;  // light by light, against rays
};

// What it holds at most: its transfer, and its light as sums and at vertices [bytes].
size_t mostBytesOf(const PrtNeeds& needs);

// Which of them fit into so much memory together: the smallest first, so that they are many, and of
// the same size in their order.
std::vector<bool> fitting(std::span<const size_t> bytes, size_t room);

}  // namespace lamplighter
