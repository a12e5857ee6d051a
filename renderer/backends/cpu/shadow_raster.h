// Shadow maps of simple objects by rasterisation, of what is left by rays (paper 1, 4.2.1: few
// large polygons hide most, and are nothing to draw).
//
// A map's texels are rays from one point, or parallel ones. As for the camera (raster.h), a ray d
// meets a triangle a, b, c where d·(b×c), d·(c×a) and d·(a×b) have one sign, in light space; no
// matter how the map folds the directions, nothing is clipped. What is stored, 1/w or a height, is
// linear in d over a plane too. Objects of many triangles, and with alpha masks, are left to rays:
// of texels that may see one of them all that is met is found by its ray, so that both ways give
// the same map but for rounding at edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

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
  // shaders/shared/vpl_shading.h for what is stored). The number of rays that were cast.
  uint64_t render(const RayCaster& rays, const shared::Vpl& vpl, int firstRow, int lastRow,
                  std::span<float> map) const;

 private:
  struct Light;     // its space
  struct Triangle;  // seen from a light
  struct Batch;     // eight of them
  // Of three corners in the world, all x, all y, all z.
  using Corners = std::array<std::array<std::vector<float>, 3>, 3>;
  struct Sphere {
    vec3 centre;
    float radius;
  };
  bool markForRays(const Light& light, int firstRow, int lastRow,
                   std::vector<uint8_t>& marks) const;
  void prepare(const Light& light, size_t first, Batch& out) const;
  void draw(const Triangle& triangle, const TexelDirections& directions, float most, int firstRow,
            int lastRow, std::span<float> map) const;

  bool isUseful_ = false;
  size_t triangles_ = 0;  // of simple objects
  Corners corners_;
  std::vector<Sphere> complex_;                // around the other objects
  int resolution_ = 0, tile_ = 0, tiles_ = 0;  // tile_: texels [0: rays alone]
  TexelDirections hemisphere_, parallel_;
};

}  // namespace lamplighter::cpu
