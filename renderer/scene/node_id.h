// How nodes are told apart.
#pragma once

#include <cstdint>

namespace lamplighter {

// Stable for the life of a document; never given twice. 0 is no node.
using NodeId = uint32_t;
inline constexpr NodeId kNoNode = 0;

}  // namespace lamplighter
