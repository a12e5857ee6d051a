// Order in which missing vertices are computed (paper 4, section 4).
#pragma once

#include <cstdint>
#include <vector>

namespace lamplighter {

// paper: starts at the highest priority; draws a random request and continues there if its priority
// is higher, otherwise at the next one in the list. sorted: highest priority first. random: random
// order.
enum class MeshPriority : uint8_t { paper, sorted, random };

// A request for a vertex of the mesh of a light.
struct MeshRequest {
  uint32_t mesh = 0, vertex = 0;
  float priority = 0.0f;
};

// Keeps only the first `most` requests of the order, each vertex of a mesh once. `seed`: for random
// numbers. The input must be in the order of the picture, so that neighbours are close in the list.
void takeFirst(std::vector<MeshRequest>& requests, size_t most, MeshPriority priority,
               uint32_t seed);

}  // namespace lamplighter
