#include "renderer/backends/gl/many_lights/vpl_buffer.h"

#include <algorithm>

#include "shaders/shared/bindings.h"

namespace lamplighter::gl {

VplBuffer::VplBuffer() : buffer_(Buffer::make()), texels_(Texture::make(GL_TEXTURE_BUFFER)) {
  // The standard guarantees 16 KB; more than 64 KB does not help, because passes should stay short.
  GLint limit = 0;
  glGetIntegerv(GL_MAX_UNIFORM_BLOCK_SIZE, &limit);
  capacity_ = static_cast<int>(static_cast<size_t>(std::min(limit, 65536)) / sizeof(shared::Vpl));
  glNamedBufferStorage(buffer_.name(), capacity_ * static_cast<GLsizeiptr>(sizeof(shared::Vpl)),
                       nullptr, GL_DYNAMIC_STORAGE_BIT);
  static_assert(sizeof(shared::Vpl) == 5 * sizeof(glm::vec4));
  glTextureBuffer(texels_.name(), GL_RGBA32I, buffer_.name());
}

std::string VplBuffer::define() const { return "VPLS_A_PASS " + std::to_string(capacity_); }

void VplBuffer::upload(std::span<const shared::Vpl> vpls) const {
  if (!vpls.empty()) {
    glNamedBufferSubData(buffer_.name(), 0, static_cast<GLsizeiptr>(vpls.size_bytes()),
                         vpls.data());
  }
  glBindBufferBase(GL_UNIFORM_BUFFER, shared::kVplBlock, buffer_.name());
  glBindTextureUnit(shared::kVplTexels, texels_.name());
}

}  // namespace lamplighter::gl
