// The images of a scene as OpenGL textures, kept while a material of the scene uses them.
#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "renderer/gl/objects.h"
#include "renderer/scene/scene.h"

namespace lamplighter::gl {

class TextureCache {
 public:
  // Returns the texture, uploaded on first use; one mipmap level, filter and wrap mode as given.
  // `srgb`: decode on sampling. Throws InputError if it is too large for the device.
  GLuint get(const lamplighter::Texture& texture, bool srgb);
  // endUse() deletes the textures that no get() since beginUse() returned.
  void beginUse();
  void endUse();

  uint64_t bytes() const;

 private:
  struct Entry {
    std::shared_ptr<const Image8> image;  // held so that no other image gets its address
    Texture texture;
    bool used = false;
  };
  using Key = std::tuple<const Image8*, bool, Wrap, Wrap, bool>;
  std::map<Key, Entry> entries_;
};

}  // namespace lamplighter::gl
