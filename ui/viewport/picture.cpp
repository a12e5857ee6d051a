#include "ui/viewport/picture.h"

#include <epoxy/gl.h>

#include "renderer/image/tone_map.h"

namespace lamplighter {

Picture::Picture() = default;

Picture::~Picture() {
  if (texture_ != 0) glDeleteTextures(1, &texture_);
}

void Picture::show(const std::shared_ptr<RadianceImage>& radiance, float exposureEv) {
  if (!radiance) return;
  const Image8 image = toneMap(radiance->pixels(), exposureEv);
  if (image.width != width_ || image.height != height_ || texture_ == 0) {
    if (texture_ != 0) glDeleteTextures(1, &texture_);
    width_ = image.width;
    height_ = image.height;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
    glTextureStorage2D(texture_, 1, GL_RGBA8, width_, height_);
    glTextureParameteri(texture_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(texture_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glTextureSubImage2D(texture_, 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE,
                      image.pixels.data());
}

}  // namespace lamplighter
