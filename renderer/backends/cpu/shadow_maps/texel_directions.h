// The directions of shadow map texels in light space, equal for all lights of one kind.
#pragma once

#include <cstddef>
#include <vector>

namespace lamplighter::cpu {

struct TexelDirections {
  // By block of texels (shadow_maps.h), row by row: the directions of its eight texels, ...
  std::vector<float> x, y, z;
  // ... its middle direction (unit, except for directional lights), and the largest angle between
  // it and a texel as cosine and sine; for directional lights `cosine` is a distance.
  std::vector<float> midX, midY, midZ, cosine, sine;
  // At the corners of tiles, row by row; entries after the last of a row repeat it.
  static constexpr size_t kCornersARow = 24;
  std::vector<float> cornerX, cornerY, cornerZ;
};

// For a map with `resolution` texels per side and tiles of `tile` texels per side, which must
// divide it. For directional lights: (u, v, 1) in the map's square [-1, 1]².
TexelDirections texelDirections(int resolution, int tile, bool isParallel);

}  // namespace lamplighter::cpu
