#include "renderer/backends/gl/shading_points.h"

#include "shaders/shared/bindings.h"

namespace lamplighter::gl {

void ShadingPoints::resize(int width, int height) {
  position = makeTexture2D(GL_RGBA32F, width, height);
  normals = makeTexture2D(GL_RGBA32F, width, height);
}

void ShadingPoints::bind() const {
  glBindTextureUnit(shared::kGPosition, position.name());
  glBindTextureUnit(shared::kGNormals, normals.name());
}

}  // namespace lamplighter::gl
