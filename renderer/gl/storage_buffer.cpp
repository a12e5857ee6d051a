#include "renderer/gl/storage_buffer.h"

namespace lamplighter::gl {

uint64_t mostStorageBytes() {
  GLint64 limit = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
  return static_cast<uint64_t>(limit);
}

}  // namespace lamplighter::gl
