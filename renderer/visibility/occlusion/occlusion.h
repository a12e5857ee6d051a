// The state of a light on a patch.
#pragma once

#include <cstdint>

namespace lamplighter {

// Conservative: partial if not certain.
enum class Occlusion : uint8_t {
  none,     // nothing blocks the light from any point of the patch
  partial,  // something may block it
  full      // no visible point gets light: all is in shadow, or back-facing
};

}  // namespace lamplighter
