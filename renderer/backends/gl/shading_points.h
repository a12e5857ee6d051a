// The points that light is summed at: of all pixels of a G-buffer, or of samples of it.
#pragma once

#include "renderer/gl/objects.h"

namespace lamplighter::gl {

struct ShadingPoints {
  // RGBA32F, as shaders/shared/bindings.h says of kGPosition and kGNormals.
  Texture position, normals;

  void resize(int width, int height);
  void bind() const;
  static uint64_t bytes(int width, int height) {
    return uint64_t{2 * 16} * static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
  }
};

}  // namespace lamplighter::gl
