#include "renderer/backends/gl/many_lights/sum_target.h"

namespace lamplighter::gl {

void SumTarget::resize(int newWidth, int newHeight) {
  if (irradiance && newWidth == width && newHeight == height) return;
  dropPlaces();
  width = newWidth;
  height = newHeight;
  irradiance = makeTexture2D(GL_RGBA32F, width, height);
  sums = Framebuffer::make();
  glNamedFramebufferTexture(sums.name(), GL_COLOR_ATTACHMENT0, irradiance.name(), 0);
}

void SumTarget::addPlaces() {
  if (places) return;
  places = makeTexture2D(GL_R32UI, width, height);
  begin = Framebuffer::make();
  glNamedFramebufferTexture(begin.name(), GL_COLOR_ATTACHMENT0, irradiance.name(), 0);
  glNamedFramebufferTexture(begin.name(), GL_COLOR_ATTACHMENT1, places.name(), 0);
  constexpr GLenum kTargets[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glNamedFramebufferDrawBuffers(begin.name(), 2, kTargets);
}

void SumTarget::addStencil() {
  if (stencil) return;
  stencil = makeTexture2D(GL_DEPTH24_STENCIL8, width, height);
  for (const Framebuffer* framebuffer : {&sums, &begin})
    glNamedFramebufferTexture(framebuffer->name(), GL_DEPTH_STENCIL_ATTACHMENT, stencil.name(), 0);
}

void SumTarget::dropStencil() {
  if (!stencil) return;
  for (const Framebuffer* framebuffer : {&sums, &begin})
    if (*framebuffer)
      glNamedFramebufferTexture(framebuffer->name(), GL_DEPTH_STENCIL_ATTACHMENT, 0, 0);
  stencil = {};
}

uint64_t SumTarget::bytes() const {
  const uint64_t pixel = (irradiance ? 16u : 0u) + (places ? 4u : 0u) + (stencil ? 4u : 0u);
  return pixel * static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
}

}  // namespace lamplighter::gl
