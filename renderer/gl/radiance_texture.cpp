#include "renderer/gl/radiance_texture.h"

namespace lamplighter::gl {

const Image& RadianceTexture::pixels() {
  if (pixels_.empty()) pixels_ = readBack(texture(), width_, height_);
  return pixels_;
}

Image readBack(GLuint texture, int width, int height) {
  Image image(width, height);
  // Four channels: the driver then copies instead of repacking.
  std::vector<vec4> texels(image.pixels.size());
  glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT,
                    static_cast<GLsizei>(texels.size() * sizeof(vec4)), texels.data());
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
