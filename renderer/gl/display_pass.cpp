#include "renderer/gl/display_pass.h"

#include <cmath>

#include "renderer/gl/pass_state.h"
#include "renderer/gl/radiance_texture.h"

namespace lamplighter::gl {

DisplayPass::DisplayPass(const std::filesystem::path& shaders)
    : vertexArray_(VertexArray::make()), framebuffer_(Framebuffer::make()) {
  reload(shaders);
}

void DisplayPass::reload(const std::filesystem::path& shaders) {
  program_ = Program(shaders, {"common/full_screen.vert.glsl", "passes/display.frag.glsl"});
}

GLuint DisplayPass::render(const std::shared_ptr<RadianceImage>& image, float exposureEv,
                           ToneMapper mapper) {
  if (width_ != image->width() || height_ != image->height()) {
    resize(image->width(), image->height());
  }
  const GLuint texture = textureOf(*image) != 0 ? textureOf(*image) : upload(image);
  draw(texture, exposureEv, mapper, framebuffer_.name(), width_, height_);
  return target_.name();
}

void DisplayPass::draw(GLuint radianceTexture, float exposureEv, ToneMapper mapper,
                       GLuint framebuffer, int width, int height) {
  const PassState state(framebuffer, width, height);
  program_.set(0, std::exp2(exposureEv));
  program_.set(1, static_cast<int>(mapper));
  program_.use();
  glBindTextureUnit(0, radianceTexture);
  drawFullScreen(vertexArray_.name());
}

GLuint DisplayPass::upload(const std::shared_ptr<RadianceImage>& image) {
  // Compares owners, not addresses: a later picture may have the same address.
  if (uploadedFrom_ != image) {
    glTextureSubImage2D(uploaded_.name(), 0, 0, 0, width_, height_, GL_RGB, GL_FLOAT,
                        image->pixels().pixels.data());
    uploadedFrom_ = image;
  }
  return uploaded_.name();
}

void DisplayPass::resize(int width, int height) {
  width_ = width;
  height_ = height;
  target_ = makeTexture2D(GL_RGBA8, width, height, GL_LINEAR);
  // Three floats per texel as in main memory, so no conversion.
  uploaded_ = makeTexture2D(GL_RGB32F, width, height);
  uploadedFrom_.reset();
  glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, target_.name(), 0);
}

}  // namespace lamplighter::gl
