#include "renderer/gl/radiance_texture.h"

#include <algorithm>

namespace lamplighter::gl {

const Image& RadianceTexture::pixels() {
  if (pixels_.empty()) pixels_ = readBack(passes_->waits(), texture(), width_, height_);
  return pixels_;
}

std::shared_ptr<RadianceImage> RadianceTexture::averaged(int block) {
  block = std::min({std::max(block, 1), width_, height_});
  auto small =
      std::make_shared<RadianceTexture>(blocksOf(width_, block), blocksOf(height_, block), passes_);
  passes_->average(texture(), block, small->texture(), {small->width(), small->height()});
  return small;
}

Image readBack(Waits& waits, GLuint texture, int width, int height) {
  Image image(width, height);
  // Four channels: the driver then copies instead of repacking.
  std::vector<vec4> texels(image.pixels.size());
  waits.readTexture(texture, GL_RGBA, GL_FLOAT, texels.size() * sizeof(vec4), texels.data());
  for (size_t i = 0; i < texels.size(); ++i) image.pixels[i] = vec3(texels[i]);
  return image;
}

}  // namespace lamplighter::gl

namespace lamplighter {

uint32_t textureOf(const RadianceImage& image) {
  const auto* texture = dynamic_cast<const gl::RadianceTexture*>(&image);
  return texture == nullptr ? 0 : texture->texture();
}

}  // namespace lamplighter
