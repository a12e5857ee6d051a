// A frame's picture that is stored in a texture.
#pragma once

#include <memory>
#include <utility>

#include "renderer/backends/radiance_image.h"
#include "renderer/gl/objects.h"
#include "renderer/gl/picture_passes.h"

namespace lamplighter::gl {

// RGBA32F; row 0 of the texture is the top of the picture. The context must be current at the first
// call of pixels(), at averaged(), and when the last owner releases it.
class RadianceTexture final : public RadianceImage {
 public:
  RadianceTexture(int width, int height, std::shared_ptr<PicturePasses> passes)
      : passes_(std::move(passes)),
        texture_(makeTexture2D(GL_RGBA32F, width, height)),
        width_(width),
        height_(height) {}
  int width() const override { return width_; }
  int height() const override { return height_; }
  // Waits for the GPU at the first call.
  const Image& pixels() override;
  bool isInMainMemory() const override { return false; }
  std::shared_ptr<RadianceImage> averaged(int block) override;

  GLuint texture() const { return texture_.name(); }
  void forgetPixels() { pixels_ = Image(); }  // call after drawing to the texture again

 private:
  std::shared_ptr<PicturePasses> passes_;
  Texture texture_;
  int width_, height_;
  Image pixels_;
};

// Reads back the colour of a texture of any float format; row 0 stays row 0.
Image readBack(Waits& waits, GLuint texture, int width, int height);

}  // namespace lamplighter::gl

namespace lamplighter {

// The texture that holds the picture; 0 if it is in main memory.
uint32_t textureOf(const RadianceImage& image);

}  // namespace lamplighter
