// The frame's picture as a texture that ImGui can draw: tone-mapped, display-referred.
#pragma once

#include <cstdint>
#include <memory>

#include "renderer/backends/kernels.h"
#include "renderer/debug_views/view_picture.h"
#include "renderer/gl/objects.h"

namespace lamplighter {

namespace gl {
class DisplayPass;
}  // namespace gl

class Picture {
 public:
  Picture();
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  // Shows this radiance at this exposure. Needs a current OpenGL context, then and when this ends.
  void show(const std::shared_ptr<RadianceImage>& radiance, float exposureEv, ToneMapper mapper);
  // Shows a picture that is of the display already.
  void show(const std::shared_ptr<const ViewPicture>& picture);
  uint32_t texture() const { return texture_; }  // 0: nothing yet

 private:
  std::unique_ptr<gl::DisplayPass> pass_;  // made when first needed: there may be no OpenGL
  gl::Texture view_;
  std::shared_ptr<const ViewPicture> viewFrom_;  // what is in it
  uint32_t texture_ = 0;
};

}  // namespace lamplighter
