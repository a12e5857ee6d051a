// The points where light is summed: all pixels of a G-buffer, or samples of them.
#pragma once

#include "renderer/gl/objects.h"

namespace lamplighter::gl {

struct ShadingPoints {
  // RGBA32F; layout as for kGPosition and kGNormals in shaders/shared/bindings.h.
  Texture position, normals;

  void resize(int width, int height);
  void bind() const;
  static uint64_t bytes(int width, int height) {
    return uint64_t{2 * 16} * static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
  }
};

}  // namespace lamplighter::gl
