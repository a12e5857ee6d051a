// The frame's picture as a texture that ImGui can draw: tone-mapped, display-referred.
#pragma once

#include <cstdint>
#include <memory>

#include "renderer/methods/gi_method.h"

namespace lamplighter {

class Picture {
 public:
  Picture();
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  // Shows this radiance at this exposure. Needs a current OpenGL context.
  void show(const std::shared_ptr<RadianceImage>& radiance, float exposureEv);
  uint32_t texture() const { return texture_; }  // 0: nothing yet

 private:
  uint32_t texture_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace lamplighter
