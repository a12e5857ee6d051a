// Shadow maps of simple objects by rasterisation, of what is left by rays (paper 1, 4.2.1: few
// large polygons hide most, and are nothing to draw).
//
// A map's texels are rays from one point, or parallel ones; shadow_triangles.h says how triangles
// are found on them. Objects of many triangles, and with alpha masks, are left to rays: of texels
// that may see one of them all that is met is found by its ray, so that both ways give the same map
// but for rounding at edges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/shadow_triangles.h"
#include "renderer/backends/cpu/texel_directions.h"
#include "renderer/raycast/ray_caster.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::cpu {

class ShadowRaster {
 public:
  // What casts shadows, as it is now.
  void setScene(const RenderScene& scene);
  void setResolution(int resolution);

  // Renders rows [firstRow, lastRow) of the map of `vpl` into `map` (resolution², see
  // shaders/shared/vpl_shading.h for what is stored). Whether rows are worth rasterising is decided
  // by kBand of them: firstRow is a multiple of it. The number of rays that were cast.
  uint64_t render(const RayCaster& rays, const shared::Vpl& vpl, int firstRow, int lastRow,
                  std::span<float> map) const;
  static constexpr int kBand = 32;

 private:
  struct Band;
  struct Sphere {
    vec3 centre;
    float radius;
  };
  const TexelDirections& directions(const LightSpace& light) const {
    return light.isParallel ? parallel_ : hemisphere_;
  }
  bool markForRays(const LightSpace& light, Band& band) const;
  void passOverMarked(Band& band) const;
  void draw(const ShadowTriangles::Batch& batch, size_t lane, const LightSpace& light, Band& band,
            std::span<float> map) const;

  bool isUseful_ = false;
  ShadowTriangles triangles_;                  // of simple objects
  std::vector<Sphere> complex_;                // around the other objects
  int resolution_ = 0, tile_ = 0, tiles_ = 0;  // tile_: texels [0: rays alone]
  TexelDirections hemisphere_, parallel_;
};

}  // namespace lamplighter::cpu
