// The triangles that a picture shows, with their pixels.
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

class VisibleTriangles {
 public:
  struct Triangle {
    uint32_t object = 0, triangle = 0;  // within the object
    bool isBack = false;                // its back face is visible
    uint32_t first = 0, count = 0;      // pixels
  };
  struct Pixel {
    uint32_t index = 0;  // row by row from the top left
    vec3 weights{0.0f};  // of the corners
  };

  VisibleTriangles() = default;
  VisibleTriangles(const RenderScene& scene, const GBufferView& gbuffer);

  // Ascending by object, triangle and side.
  std::span<const Triangle> triangles() const { return triangles_; }
  std::span<const Pixel> pixelsOf(const Triangle& t) const {
    return std::span(pixels_).subspan(t.first, t.count);
  }
  size_t pixels() const { return pixels_.size(); }  // number of pixels that show a surface

 private:
  std::vector<Triangle> triangles_;
  std::vector<Pixel> pixels_;  // by triangle
};

}  // namespace lamplighter
