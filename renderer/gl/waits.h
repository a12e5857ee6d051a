// The calls that wait for the GPU. Nothing else may: tests/layers_test.sh checks it.
#pragma once

#include <cstddef>
#include <cstdint>

#include <epoxy/gl.h>

#include "renderer/base/math.h"

namespace lamplighter::gl {

// Counts its calls. A frame with none leaves the GPU at work while the next one is prepared.
class Waits {
 public:
  uint64_t count() const { return count_; }

  // Until all submitted work is done.
  void finish();
  // Copies the largest level of a texture to `to`, which has room for `bytes`.
  void readTexture(GLuint texture, GLenum format, GLenum type, size_t bytes, void* to);
  // The same for one layer of an array of textures.
  void readLayer(GLuint array, int layer, glm::ivec2 size, GLenum format, GLenum type, size_t bytes,
                 void* to);

 private:
  uint64_t count_ = 0;
};

}  // namespace lamplighter::gl
