// The picture of the frame as a texture for ImGui: tone-mapped, display-referred.
#pragma once

#include <cstdint>
#include <memory>

#include "renderer/backends/radiance_image.h"
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

  // Shows radiance at an exposure. Needs a current OpenGL context, here and in the destructor.
  void show(const std::shared_ptr<RadianceImage>& radiance, float exposureEv, ToneMapper mapper);
  // Shows a picture that is already display-referred.
  void show(const std::shared_ptr<const ViewPicture>& picture);
  uint32_t texture() const { return texture_; }  // 0: no picture yet

 private:
  std::unique_ptr<gl::DisplayPass> pass_;  // created on demand: there may be no OpenGL
  gl::Texture view_;
  std::shared_ptr<const ViewPicture> viewFrom_;  // the picture in the texture
  uint32_t texture_ = 0;
};

}  // namespace lamplighter
