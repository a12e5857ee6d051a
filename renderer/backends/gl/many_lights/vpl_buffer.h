// The buffer with the VPLs of a pass, bound as a uniform block and as a buffer texture.
#pragma once

#include <span>
#include <string>

#include "renderer/gl/objects.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::gl {

class VplBuffer {
 public:
  VplBuffer();
  int capacity() const { return capacity_; }
  // "VPLS_A_PASS n", for shaders/common/vpls.glsl.
  std::string define() const;
  // Uploads at most capacity() VPLs and binds the buffer.
  void upload(std::span<const shared::Vpl> vpls) const;

 private:
  Buffer buffer_;
  Texture texels_;
  int capacity_ = 0;
};

}  // namespace lamplighter::gl
