// Potential light samples: the vertices of light paths from all lights in one grid, like the texels
// of reflective shadow maps (paper 2, section 3.2; Dachsbacher and Stamminger 2005), but for every
// kind of light and several bounces.
//
// Each light has a block of columns for each bounce. The paths of a block are a (0, 2)-net in the
// direction in which they leave the light (for suns and skies: in the position at which they enter
// the scene), so each cell of the block has exactly one path, and neighbours in the grid leave the
// light in similar directions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/sampling/emitters/lights.h"
#include "renderer/sampling/path_tracing.h"
#include "renderer/shadow_maps/refresh_scheduler.h"

namespace lamplighter {

struct ReflectiveMapOptions {
  int texels = 24576;  // requested total, over all bounces
  int bounces = 2;
  uint32_t seed = 1;
  bool operator==(const ReflectiveMapOptions&) const = default;
};

class ReflectiveMap {
 public:
  static constexpr int kRows = 64;  // rows of the grid

  // The columns of one light at one bounce.
  struct Block {
    int emitter = 0;  // index into LightSet::emitters()
    VplId light;      // id of its samples, with bounce and index 0
    uint32_t bounce = 1;
    int first = 0, columns = 0;
    size_t paths = 0;  // index of the first one
  };

  // Updates the map after changes of the scene. Only affected paths are traced again; the result is
  // bitwise equal to a new map. `movers`: since the last call. Returns whether anything may have
  // changed.
  bool update(const RenderScene& scene, const RayCaster& rays, const RenderSceneChanges& changes,
              std::span<const MoverFinder::Mover> movers, const ReflectiveMapOptions& options);

  int columns() const { return columns_; }
  size_t size() const { return static_cast<size_t>(columns_) * kRows; }
  // Column by column; the index of a texel is column · kRows + row.
  static size_t indexOf(int column, int row) {
    return static_cast<size_t>(column) * kRows + static_cast<size_t>(row);
  }
  std::span<const Block> blocks() const { return blocks_; }
  const Block& blockOf(int column) const {
    return blocks_[blockOfColumn_[static_cast<size_t>(column)]];
  }

  // By texel, in world space. A texel without a hit has an intensity of 0.
  struct Texels {
    std::vector<float> x, y, z;           // [m], off the surface
    std::vector<float> nx, ny, nz;        // unit, on the side that reflects
    std::vector<float> red, green, blue;  // intensity along the normal [W/sr], I = ρ·Φ/π
    vec3 position(size_t i) const { return {x[i], y[i], z[i]}; }
    vec3 normal(size_t i) const { return {nx[i], ny[i], nz[i]}; }
    vec3 intensity(size_t i) const { return {red[i], green[i], blue[i]}; }
  };
  const Texels& texels() const { return texels_; }
  // Index of the path of a texel in the sequence of its light.
  uint32_t pathOf(size_t texel) const { return pathIndex_[texel]; }
  // A light sample at the position of a texel. The rotation of its shadow map depends on its id.
  SceneVpl sampleOf(int column, int row) const;

  uint64_t rays() const { return rays_; }  // in the last update
  int walked() const { return walked_; }   // paths, in the last update

 private:
  void divide();
  void place(const PathWalker& walker, const Block& block);
  void walk(const PathWalker& walker, const Block& block, bool keeps,
            std::span<const MoverFinder::Mover> movers);
  void fill(const Block& block);

  ReflectiveMapOptions options_;
  bool isStarted_ = false;
  LightSet lights_;
  VplCounts counts_;
  int columns_ = 0;
  std::vector<Block> blocks_;  // first those of the first bounce, then of the second, ...
  std::vector<size_t> blockOfColumn_;
  std::vector<LightPath> paths_;  // by cell of a block
  float scale_ = 1.0f;            // for lights that have no columns
  Texels texels_;
  std::vector<uint32_t> pathIndex_;  // by texel
  uint64_t rays_ = 0;
  int walked_ = 0;
};

}  // namespace lamplighter
