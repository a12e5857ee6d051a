// The type of node ids.
#pragma once

#include <cstdint>

namespace lamplighter {

// Stable during the life of a document; never reused. 0 means no node.
using NodeId = uint32_t;
inline constexpr NodeId kNoNode = 0;

}  // namespace lamplighter
