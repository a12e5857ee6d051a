// The G-buffer as a method reads it in main memory: what each pixel of the picture shows.
#pragma once

#include <cstddef>

#include "renderer/backends/cpu/gbuffer/gbuffer.h"

namespace lamplighter {

// The surface at the sample position of a pixel. World space, metres; unit normals on the side that
// faces the eye.
struct GBufferPoint {
  vec3 position{0.0f};
  vec3 normal{0.0f};           // shading normal
  vec3 geometricNormal{0.0f};  // of the triangle
  vec3 albedo{0.0f};           // ρ of the Lambertian surface, in [0, 1]
  vec3 emission{0.0f};         // towards the eye [W/(m² sr)]
  uint32_t object = 0;         // index into RenderScene::objects
  uint32_t triangle = 0;       // within the object
};

// A view of a G-buffer that someone else owns.
class GBufferView {
 public:
  explicit GBufferView(const cpu::GBuffer& gbuffer) : g_(gbuffer) {}

  int width() const { return g_.width; }
  int height() const { return g_.height; }
  // Whether the pixel shows a surface, and not the sky. (0, 0) is the top left pixel.
  bool isHit(int x, int y) const { return g_.hit[g_.index(x, y)] != 0; }
  // Only where isHit().
  GBufferPoint at(int x, int y) const {
    const size_t i = g_.index(x, y);
    return {{g_.px[i], g_.py[i], g_.pz[i]},
            {g_.sx[i], g_.sy[i], g_.sz[i]},
            {g_.gx[i], g_.gy[i], g_.gz[i]},
            g_.albedo(i),
            g_.emission(i),
            g_.object[i],
            g_.triangle[i]};
  }
  // All of it, in packets of eight pixels.
  const cpu::GBuffer& packets() const { return g_; }

 private:
  const cpu::GBuffer& g_;
};

}  // namespace lamplighter
