// A frame's picture that is stored in a texture.
#pragma once

#include <memory>

#include "renderer/backends/radiance_image.h"
#include "renderer/gl/objects.h"

namespace lamplighter::gl {

// RGBA32F; row 0 of the texture is the top of the picture. The context must be current at the first
// call of pixels() and when the last owner releases it.
class RadianceTexture final : public RadianceImage {
 public:
  RadianceTexture(int width, int height)
      : texture_(makeTexture2D(GL_RGBA32F, width, height)), width_(width), height_(height) {}
  int width() const override { return width_; }
  int height() const override { return height_; }
  const Image& pixels() override;

  GLuint texture() const { return texture_.name(); }
  void forgetPixels() { pixels_ = Image(); }  // call after drawing to the texture again

 private:
  Texture texture_;
  int width_, height_;
  Image pixels_;
};

// Reads back the colour of a texture of any float format; row 0 stays row 0.
Image readBack(GLuint texture, int width, int height);

}  // namespace lamplighter::gl

namespace lamplighter {

// The texture that holds the picture; 0 if it is in main memory.
uint32_t textureOf(const RadianceImage& image);

}  // namespace lamplighter
