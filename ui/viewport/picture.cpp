#include "ui/viewport/picture.h"

#include "renderer/gl/display_pass.h"

namespace lamplighter {

Picture::Picture() = default;
Picture::~Picture() = default;

void Picture::show(const std::shared_ptr<RadianceImage>& radiance, float exposureEv,
                   ToneMapper mapper) {
  if (!radiance) return;
  if (!pass_) pass_ = std::make_unique<gl::DisplayPass>();
  texture_ = pass_->render(radiance, exposureEv, mapper);
}

void Picture::show(const std::shared_ptr<const ViewPicture>& picture) {
  const Image8& image = picture->image;
  if (viewFrom_ != picture) {
    const bool fits = viewFrom_ && viewFrom_->image.width == image.width &&
                      viewFrom_->image.height == image.height;
    if (!fits) view_ = gl::makeTexture2D(GL_RGBA8, image.width, image.height, GL_LINEAR);
    glTextureSubImage2D(view_.name(), 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                        image.pixels.data());
    viewFrom_ = picture;
  }
  texture_ = view_.name();
}

}  // namespace lamplighter
