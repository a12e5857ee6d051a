// How the work of a bake is cut: tiles of pages, each a file of its own until the pages are put
// together. So a bake that was cancelled goes on, and machines share one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/bake/atlas.h"
#include "renderer/bake/bake_points.h"

namespace lamplighter {

inline constexpr int kTileSide = 64;  // texels

// What one tile has to find: points that stand together, those of one texel next to each other.
struct BakeTile {
  int number = 0;  // among those of all pages that have points, in their order
  int page = 0;
  std::vector<BakePoint> points;
};

std::vector<BakeTile> bakeTiles(const RenderScene& scene, const LightMapAtlas& atlas);

// One texel's light, as BakedLight finds it.
struct BakedTexel {
  uint16_t x = 0, y = 0;
  vec3 irradiance{0.0f};
};

// The folder of finished tiles.
class BakeParts {
 public:
  // `key` tells bakes with another outcome apart: their tiles are not found.
  BakeParts(const std::filesystem::path& output, uint64_t key);

  bool has(const BakeTile& tile) const;
  // Whole or not at all. Throws InputError when it cannot be written.
  void write(const BakeTile& tile, std::span<const BakedTexel> texels) const;
  // Nothing where it is not there, or not whole.
  std::optional<std::vector<BakedTexel>> read(const BakeTile& tile) const;
  // They are of no more use.
  void remove() const;

 private:
  std::filesystem::path pathOf(const BakeTile& tile) const;
  std::filesystem::path folder_;
};

}  // namespace lamplighter
