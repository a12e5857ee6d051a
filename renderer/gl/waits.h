// The calls that wait for the GPU. No other code may wait for it: tests/layers_test.sh checks this.
#pragma once

#include <cstddef>
#include <cstdint>

#include <epoxy/gl.h>

#include "renderer/base/math.h"

namespace lamplighter::gl {

// Counts its calls. In a frame without such calls, the GPU continues to work while the next frame
// is prepared.
class Waits {
 public:
  uint64_t count() const { return count_; }

  // Waits until all submitted work is done.
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
