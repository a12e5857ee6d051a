// The directions of a shadow map's texels in light space, the same for all lights.
#pragma once

#include <cstddef>
#include <vector>

namespace lamplighter::cpu {

struct TexelDirections {
  // By block of texels (shadow_maps.h), row after row: those of its eight texels, ...
  std::vector<float> x, y, z;
  // ... its middle (unit, but for parallel lights), and how far the texels are from that: an
  // angle's cosine and sine; of parallel lights a distance in `cosine`.
  std::vector<float> midX, midY, midZ, cosine, sine;
  // At the corners of tiles, row after row; past the last of a row as there.
  static constexpr size_t kCornersARow = 24;
  std::vector<float> cornerX, cornerY, cornerZ;
};

// Of a map of so many texels a side, cut into tiles of `tile` texels a side, which divides it; of
// parallel lights' maps (u, v, 1) in the map's square [-1, 1]².
TexelDirections texelDirections(int resolution, int tile, bool isParallel);

}  // namespace lamplighter::cpu
