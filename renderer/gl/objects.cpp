#include "renderer/gl/objects.h"

namespace lamplighter::gl {

Texture makeTexture2D(GLenum internalFormat, int width, int height, GLenum filter) {
  Texture texture = Texture::make(GL_TEXTURE_2D);
  glTextureStorage2D(texture.name(), 1, internalFormat, width, height);
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, static_cast<GLint>(filter));
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, static_cast<GLint>(filter));
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

void bindImage(GLuint unit, const Texture& texture, GLenum format, GLenum access) {
  glBindImageTexture(unit, texture.name(), 0, GL_TRUE, 0, access, format);
}

}  // namespace lamplighter::gl
