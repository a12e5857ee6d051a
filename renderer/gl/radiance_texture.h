// A frame's picture that lies in a texture.
#pragma once

#include <memory>

#include "renderer/backends/kernels.h"
#include "renderer/gl/objects.h"

namespace lamplighter::gl {

// RGBA32F, row 0 of the texture is the top of the picture. The context must be current when
// pixels() is first called and when the last owner lets go.
class RadianceTexture final : public RadianceImage {
 public:
  RadianceTexture(int width, int height)
      : texture_(makeTexture2D(GL_RGBA32F, width, height)), width_(width), height_(height) {}
  int width() const override { return width_; }
  int height() const override { return height_; }
  const Image& pixels() override;

  GLuint texture() const { return texture_.name(); }
  void forgetPixels() { pixels_ = Image(); }  // the texture was drawn anew

 private:
  Texture texture_;
  int width_, height_;
  Image pixels_;
};

// Colour of a texture of any float format, read back; row 0 stays row 0.
Image readBack(GLuint texture, int width, int height);

}  // namespace lamplighter::gl

namespace lamplighter {

// The texture that holds the picture, or 0 when it lies in main memory.
uint32_t textureOf(const RadianceImage& image);

}  // namespace lamplighter
