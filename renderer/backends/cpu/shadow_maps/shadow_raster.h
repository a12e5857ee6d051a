// Shadow maps of simple objects by rasterisation, of what is left by rays (paper 1, 4.2.1: few
// large polygons hide most, and are nothing to draw).
//
// A map's texels are rays from one point, or parallel ones; shadow_triangles.h says how triangles
// are found on them. Objects of many triangles, and with alpha masks, are left to rays: of texels
// that may see one of them all that is met is found by its ray, so that both ways give the same map
// but for rounding at edges.
//
// Where something moved only a part of a map need be rendered anew: its bits are those of a whole
// one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/shadow_maps/map_blocks.h"
#include "renderer/backends/cpu/shadow_maps/shadow_triangles.h"
#include "renderer/backends/cpu/shadow_maps/texel_directions.h"
#include "renderer/raycast/ray_caster.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::cpu {

// Maps of one resolution: their tiles, and the directions of their texels.
struct ShadowMapGrid {
  ShadowMapGrid() = default;
  explicit ShadowMapGrid(int resolution);
  const TexelDirections& directions(bool isParallel) const {
    return isParallel ? parallel : hemisphere;
  }

  int resolution = 0, tile = 0, tiles = 0;  // texels a side, texels of a tile's, tiles [0: rays
                                            // alone]
  TexelDirections hemisphere, parallel;
};

class ShadowRaster {
 public:
  // What casts shadows, as it is now. `moved`: of its objects, those that did since the last call;
  // null: anything may be another.
  void setScene(const RenderScene& scene, const std::vector<uint32_t>* moved = nullptr);

  // Blocks of the light's map that may see one of these, row after row, 1 or 0 each; empty: any
  // may.
  static std::vector<uint8_t> blocksThatSee(const ShadowMapGrid& grid, const shared::Vpl& vpl,
                                            std::span<const Sphere> spheres);

  // Renders rows [firstRow, lastRow) of the map of `vpl` into `map` (the grid's resolution², see
  // shaders/shared/vpl_shading.h for what is stored). Whether rows are worth rasterising is decided
  // by kBand of them: firstRow is a multiple of it. `wanted`: blocks of all the map that are out of
  // date; empty: all are. `isTraced`: by kBand of all rows, whether they were traced, and then
  // whether they are. The number of rays that were cast.
  uint64_t render(const RayCaster& rays, const ShadowMapGrid& grid, const shared::Vpl& vpl,
                  int firstRow, int lastRow, std::span<float> map, std::span<const uint8_t> wanted,
                  std::span<uint8_t> isTraced) const;
  static constexpr int kBand = 32;

 private:
  struct Band;
  // An object that is left to rays.
  struct Complex {
    uint32_t object;
    Sphere whole;
    std::vector<Sphere> parts;  // around all of it
  };
  bool markForRays(const LightSpace& light, Band& band) const;
  template <typename F>
  static void forEachBlock(const Band& band, int ty, int tx, F&& f);
  static void prepareTiles(Band& band, std::span<const uint8_t> wanted, std::span<float> map);
  static void draw(const ShadowTriangles::Batch& batch, size_t lane, const LightSpace& light,
                   Band& band, std::span<float> map);

  bool isUseful_ = false;
  ShadowTriangles triangles_;     // of simple objects
  std::vector<Complex> complex_;  // the other objects
};

}  // namespace lamplighter::cpu
