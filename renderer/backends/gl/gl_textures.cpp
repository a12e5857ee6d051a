#include "renderer/backends/gl/gl_textures.h"

#include <algorithm>

#include "renderer/base/error.h"

namespace lamplighter::gl {
namespace {

GLint wrapMode(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return GL_REPEAT;
    case Wrap::clamp:
      return GL_CLAMP_TO_EDGE;
    case Wrap::mirror:
      return GL_MIRRORED_REPEAT;
  }
  return GL_REPEAT;
}

}  // namespace

GLuint TextureCache::get(const lamplighter::Texture& source, bool srgb) {
  const Image8& image = *source.image;
  Entry& entry = entries_[{source.image.get(), srgb, source.wrapS, source.wrapT, source.nearest}];
  entry.used = true;
  if (entry.texture) return entry.texture.name();

  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (std::max(image.width, image.height) > limit) {
    throw InputError("texture " + source.name,
                     std::to_string(image.width) + "x" + std::to_string(image.height) +
                         " texels exceed the limit of this driver (" + std::to_string(limit) + ")",
                     "make it smaller or use --backend cpu");
  }
  entry.image = source.image;
  entry.texture = makeTexture2D(srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, image.width, image.height,
                                source.nearest ? GL_NEAREST : GL_LINEAR);
  const GLuint name = entry.texture.name();
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, wrapMode(source.wrapS));
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, wrapMode(source.wrapT));
  glTextureSubImage2D(name, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                      image.pixels.data());
  return name;
}

void TextureCache::beginUse() {
  for (auto& [key, entry] : entries_) entry.used = false;
}

void TextureCache::endUse() {
  std::erase_if(entries_, [](const auto& e) { return !e.second.used; });
}

uint64_t TextureCache::bytes() const {
  uint64_t sum = 0;
  for (const auto& [key, entry] : entries_) sum += entry.image->pixels.size();
  return sum;
}

}  // namespace lamplighter::gl
