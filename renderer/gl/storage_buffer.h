// Shader storage buffers with elements of one type.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "renderer/base/error.h"
#include "renderer/gl/objects.h"

namespace lamplighter::gl {

// The largest storage buffer that shaders can access [bytes]; 128 MiB is guaranteed.
uint64_t mostStorageBytes();

// `T` has the layout std430 (shaders/shared/interop.h).
template <typename T>
class StorageBuffer {
 public:
  static_assert(std::is_trivially_copyable_v<T>);

  StorageBuffer() = default;  // without elements; needs no context

  // Sets the number of elements. If it differs, all contents are lost. Throws InputError if a
  // shader cannot access `count` elements.
  void resize(size_t count) {
    if (buffer_ && count == size_) return;
    allocate(count, nullptr);
  }
  // Replaces all elements and their number. Does not wait for commands that read the old ones.
  void set(std::span<const T> values) { allocate(values.size(), values.data()); }
  // Replaces elements, beginning with index `first`.
  void update(size_t first, std::span<const T> values) {
    if (values.empty()) return;
    glNamedBufferSubData(buffer_.name(), static_cast<GLintptr>(first * sizeof(T)),
                         static_cast<GLsizeiptr>(values.size_bytes()), values.data());
  }
  // Sets the bytes of all elements to zero.
  void clear() {
    glClearNamedBufferData(buffer_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
  }

  // For `buffer` blocks with this binding.
  void bind(GLuint binding) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer_.name());
  }
  // The same for some elements only. The byte offset must be a multiple of
  // GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT (at most 256).
  void bindRange(GLuint binding, size_t first, size_t count) const {
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, buffer_.name(),
                      static_cast<GLintptr>(first * sizeof(T)),
                      static_cast<GLsizeiptr>(count * sizeof(T)));
  }

  size_t size() const { return size_; }
  uint64_t bytes() const { return size_ * sizeof(T); }
  GLuint name() const { return buffer_.name(); }

 private:
  void allocate(size_t count, const T* values) {
    if (count > mostStorageBytes() / sizeof(T)) {
      throw InputError("OpenGL",
                       "a buffer of " + std::to_string(count * sizeof(T) >> 20) +
                           " MiB is larger than shaders can access with this driver (" +
                           std::to_string(mostStorageBytes() >> 20) + " MiB)",
                       "use --backend cpu");
    }
    if (!buffer_) buffer_ = Buffer::make();
    // Memory for at least one element, because a binding must not be empty.
    glNamedBufferData(buffer_.name(),
                      static_cast<GLsizeiptr>(std::max<size_t>(count, 1) * sizeof(T)),
                      count == 0 ? nullptr : values, GL_DYNAMIC_DRAW);
    size_ = count;
  }

  Buffer buffer_;
  size_t size_ = 0;
};

}  // namespace lamplighter::gl
