// In which order missing vertices are sampled (paper 4, section 4).
#pragma once

#include <cstdint>
#include <vector>

namespace lamplighter {

// paper: begins with a high priority; draws a triangle at random, and goes on there if its priority
// is higher, otherwise near the last one. sorted: the highest first. random: in any order.
enum class MeshPriority : uint8_t { paper, sorted, random };

// A vertex of the mesh of a light.
struct MeshRequest {
  uint32_t mesh = 0, vertex = 0;
  float priority = 0.0f;
};

// Removes all but the first `most` of the order; each vertex of a mesh once. `seed`: other random
// numbers. The input is in the order of the picture, so that neighbours are near each other.
void takeFirst(std::vector<MeshRequest>& requests, size_t most, MeshPriority priority,
               uint32_t seed);

}  // namespace lamplighter
