// Memory needed by precomputed radiance transfer, and which objects get it if not all fit.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lamplighter {

// An object for which transfer is requested.
struct PrtNeeds {
  size_t vertices = 0;
  size_t points = 0;       // light points
  size_t slots = 0;        // number of light slots
  bool isChecked = false;  // each light is checked against rays
};

// Upper bound [bytes]: transfer, light sums and irradiance at vertices.
size_t mostBytesOf(const PrtNeeds& needs);

// Which objects fit into `room` bytes together. The smallest go first, to fit as many as possible;
// objects of equal size keep their order.
std::vector<bool> fitting(std::span<const size_t> bytes, size_t room);

}  // namespace lamplighter
