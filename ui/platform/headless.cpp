#include "ui/platform/headless.h"

#include <chrono>

#include <epoxy/gl.h>

#include "ui/platform/read_pixels.h"

namespace lamplighter {

Headless::Headless(int width, int height, bool drawing, float scale)
    : size_(width, height), scale_(scale) {
  if (!drawing) return;
  glCreateTextures(GL_TEXTURE_2D, 1, &colour_);
  glTextureStorage2D(colour_, 1, GL_RGBA8, width, height);
  glCreateFramebuffers(1, &framebuffer_);
  glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, colour_, 0);
}

Headless::~Headless() {
  if (framebuffer_ == 0) return;
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &colour_);
}

void Headless::beginDrawing() {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, size_.x, size_.y);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
}

Image8 Headless::screenshot() {
  if (framebuffer_ == 0) return {};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  return readPixels(size_);
}

double Headless::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace lamplighter
