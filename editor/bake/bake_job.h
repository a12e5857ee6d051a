// Bakes a scene to files: light maps as EXR pages, and a copy of the scene with the UVs of the
// light maps.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "editor/bake/bake_layout.h"
#include "renderer/bake/baked_light.h"
#include "renderer/bake/visibility_file.h"

namespace lamplighter {

struct BakeJobOptions {
  AtlasOptions atlas;
  BakeLightOptions light;
  std::filesystem::path output;  // folder; created if it does not exist
  std::string name;              // prefix of the names of all files
  // Also writes what texels of these options see (docs/reference/visibility.md).
  std::optional<TexelRadiosityOptions> visibility;
  // Bakes only this shard of the tiles (1 … shards) and does not assemble the pages. 0: bakes all
  // tiles.
  int shard = 0, shards = 0;
  bool mergeOnly = false;  // bakes nothing; all tiles must exist
  bool keepParts = false;  // keeps the tiles after the pages are written
};

struct BakeReport {
  int pages = 0, tiles = 0, found = 0, taken = 0;  // tiles: computed now (found), reused (taken)
  bool isCancelled = false, isWhole = false;       // whole: pages and scene are written
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;
};

// Called after each tile with the number of finished tiles and the number of tiles to bake.
// Returning false stops the bake; finished tiles are kept.
using BakeProgress = std::function<bool(int done, int all)>;

// Deterministic: the pages are the same for any number of threads and shards. Throws InputError.
BakeReport bake(const Scene& scene, const BakeJobOptions& options, const BakeProgress& progress);

}  // namespace lamplighter
