// Shadow maps: simple objects are rasterised, others are traced by rays (paper 1, 4.2.1: a few
// large polygons cause most shadows and are cheap to draw).
//
// The texels of a map are rays from one point, or parallel rays; shadow_triangles.h tells how
// triangles are intersected with them. Objects with many triangles or alpha masks are traced: a
// texel that may see such an object is traced against the whole scene. Both ways give the same map,
// apart from rounding at edges.
//
// When something moved, only a part of a map needs rendering. Its bits are those of a map rendered
// completely.
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

// The grid of maps of one resolution: tiles and texel directions.
struct ShadowMapGrid {
  ShadowMapGrid() = default;
  explicit ShadowMapGrid(int resolution);
  const TexelDirections& directions(bool isParallel) const {
    return isParallel ? parallel : hemisphere;
  }

  // texels per side; texels per side of a tile; tiles per side (0: rays only)
  int resolution = 0, tile = 0, tiles = 0;
  TexelDirections hemisphere, parallel;
};

class ShadowRaster {
 public:
  // Sets the shadow casters. `moved`: the objects that moved since the last call; null: anything
  // may have changed.
  void setScene(const RenderScene& scene, const std::vector<uint32_t>* moved = nullptr);

  // Whether maps may be drawn; otherwise all are traced.
  bool isUseful() const { return isUseful_; }

  // By block of the light's map, row by row: 1 if it may see one of the spheres, otherwise 0.
  // Empty: all blocks may.
  static std::vector<uint8_t> blocksThatSee(const ShadowMapGrid& grid, const shared::Vpl& vpl,
                                            std::span<const Sphere> spheres);

  // Renders rows [firstRow, lastRow) of the map of `vpl` into `map` (resolution² texels of the
  // grid; shaders/shared/vpl_shading.h defines their values). Bands of kBand rows are either
  // rasterised or traced, so firstRow is a multiple of kBand. `wanted`: blocks of the whole map
  // that are out of date; empty: all. `isTraced`: by band of the whole map, whether it was traced
  // before; receives whether it is now. Returns the number of rays.
  uint64_t render(const RayCaster& rays, const ShadowMapGrid& grid, const shared::Vpl& vpl,
                  int firstRow, int lastRow, std::span<float> map, std::span<const uint8_t> wanted,
                  std::span<uint8_t> isTraced) const;
  static constexpr int kBand = 32;

 private:
  struct Band;
  // An object that is traced.
  struct Complex {
    uint32_t object;
    Sphere whole;
    std::vector<Sphere> parts;  // bounding spheres of its parts
  };
  bool markForRays(const LightSpace& light, Band& band) const;
  template <typename F>
  static void forEachBlock(const Band& band, int ty, int tx, F&& f);
  static void prepareTiles(Band& band, std::span<const uint8_t> wanted, std::span<float> map);
  static void draw(const ShadowTriangles::Batch& batch, size_t lane, const LightSpace& light,
                   Band& band, std::span<float> map);

  bool isUseful_ = false;
  ShadowTriangles triangles_;     // of simple objects
  std::vector<Complex> complex_;  // all other objects
};

}  // namespace lamplighter::cpu
