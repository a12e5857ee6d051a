#include "ui/viewport/picture.h"

#include "renderer/gl/display_pass.h"

namespace lamplighter {

Picture::Picture() = default;
Picture::~Picture() = default;

void Picture::show(const std::shared_ptr<RadianceImage>& radiance, float exposureEv) {
  if (!radiance) return;
  if (!pass_) pass_ = std::make_unique<gl::DisplayPass>();
  texture_ = pass_->render(radiance, exposureEv);
}

}  // namespace lamplighter
