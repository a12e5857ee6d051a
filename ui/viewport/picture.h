// The frame's picture as a texture that ImGui can draw: tone-mapped, display-referred.
#pragma once

#include <cstdint>
#include <memory>

#include "renderer/backends/kernels.h"

namespace lamplighter {

namespace gl {
class DisplayPass;
}

class Picture {
 public:
  Picture();
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  // Shows this radiance at this exposure. Needs a current OpenGL context, then and when this ends.
  void show(const std::shared_ptr<RadianceImage>& radiance, float exposureEv);
  uint32_t texture() const { return texture_; }  // 0: nothing yet

 private:
  std::unique_ptr<gl::DisplayPass> pass_;  // made when first needed: there may be no OpenGL
  uint32_t texture_ = 0;
};

}  // namespace lamplighter
