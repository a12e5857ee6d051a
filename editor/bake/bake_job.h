// A bake from scene to files: light maps as EXR pages, and a copy of the scene that carries their
// UVs.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "editor/bake/bake_layout.h"
#include "renderer/bake/baked_light.h"

namespace lamplighter {

struct BakeJobOptions {
  AtlasOptions atlas;
  BakeLightOptions light;
  std::filesystem::path output;  // a folder, made where it is not there
  std::string name;              // that files begin with
  // This part of the tiles alone is found, and pages are not put together: 1 … shards; 0: all.
  int shard = 0, shards = 0;
  bool mergeOnly = false;  // nothing is found; all tiles must be there
  bool keepParts = false;  // tiles stay when the pages are there
};

struct BakeReport {
  int pages = 0, tiles = 0, found = 0, taken = 0;  // tiles: found now; there from before
  bool isCancelled = false, isWhole = false;       // whole: pages and scene are written
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;
};

// Told after each tile how many of those to be found are; false stops, with all found tiles kept.
using BakeProgress = std::function<bool(int done, int all)>;

// Deterministic: the same pages at any number of threads, in whatever parts they are found. Throws
// InputError.
BakeReport bake(const Scene& scene, const BakeJobOptions& options, const BakeProgress& progress);

}  // namespace lamplighter
