#include "renderer/gl/waits.h"

namespace lamplighter::gl {

void Waits::finish() {
  ++count_;
  glFinish();
}

void Waits::readTexture(GLuint texture, GLenum format, GLenum type, size_t bytes, void* to) {
  ++count_;
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(texture, 0, format, type, static_cast<GLsizei>(bytes), to);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
}

void Waits::readLayer(GLuint array, int layer, glm::ivec2 size, GLenum format, GLenum type,
                      size_t bytes, void* to) {
  ++count_;
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureSubImage(array, 0, 0, 0, layer, size.x, size.y, 1, format, type,
                       static_cast<GLsizei>(bytes), to);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
}

}  // namespace lamplighter::gl
