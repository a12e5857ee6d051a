// Divides a bake into tiles of pages. Each tile is a separate file until the pages are assembled. A
// cancelled bake can therefore continue, and several machines can share one bake.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "renderer/bake/atlas.h"
#include "renderer/bake/bake_points.h"

namespace lamplighter {

inline constexpr int kTileSide = 64;  // texels

// The points that one tile computes. They are close together; the points of one texel are adjacent.
struct BakeTile {
  int number = 0;  // index among the tiles of all pages that have points
  int page = 0;
  std::vector<BakePoint> points;
};

std::vector<BakeTile> bakeTiles(const RenderScene& scene, const LightMapAtlas& atlas);

// The light of one texel, as BakedLight computes it.
struct BakedTexel {
  uint16_t x = 0, y = 0;
  vec3 irradiance{0.0f};
};

// The folder that stores the finished tiles.
class BakeParts {
 public:
  // `key` identifies bakes that give the same result. Tiles of a bake with another key are ignored.
  BakeParts(const std::filesystem::path& output, uint64_t key);

  bool has(const BakeTile& tile) const;
  // Atomic: writes the whole tile or nothing. Throws InputError if it cannot write.
  void write(const BakeTile& tile, std::span<const BakedTexel> texels) const;
  // Returns nothing if the tile does not exist or is incomplete.
  std::optional<std::vector<BakedTexel>> read(const BakeTile& tile) const;
  // Deletes the tiles when they are no longer needed.
  void remove() const;

 private:
  std::filesystem::path pathOf(const BakeTile& tile) const;
  std::filesystem::path folder_;
};

}  // namespace lamplighter
