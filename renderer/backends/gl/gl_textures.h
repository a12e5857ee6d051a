// A scene's images as OpenGL textures, kept as long as some material of the scene uses them.
#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "renderer/gl/objects.h"
#include "renderer/scene/scene.h"

namespace lamplighter::gl {

class TextureCache {
 public:
  // The texture, uploaded the first time; one level, filtered and wrapped as it says. `srgb`:
  // decoded when it is sampled. Throws InputError when it is too large for the device.
  GLuint get(const lamplighter::Texture& texture, bool srgb);
  // Between them, textures that no get() asked for are given up.
  void beginUse();
  void endUse();

  uint64_t bytes() const;

 private:
  struct Entry {
    std::shared_ptr<const Image8> image;  // keeps its address from being another image's
    Texture texture;
    bool used = false;
  };
  using Key = std::tuple<const Image8*, bool, Wrap, Wrap, bool>;
  std::map<Key, Entry> entries_;
};

}  // namespace lamplighter::gl
