// Octahedral hemisphere shadow maps (paper 1, 4.2) by rasterisation, in depth texture arrays.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "renderer/backends/gl/gl_scene.h"
#include "renderer/backends/gl/vpl_buffer.h"
#include "renderer/gl/program.h"

namespace lamplighter::gl {

class GlShadowMaps {
 public:
  GlShadowMaps(const std::filesystem::path& shaders, const VplBuffer& vpls);
  void reload(const std::filesystem::path& shaders, const VplBuffer& vpls);

  // Throws InputError when the device can't hold them.
  void reserve(int slots, int resolution);
  void render(const GlScene& scene, std::span<const shared::Vpl> vpls, const VplBuffer& buffer);
  std::vector<float> read(int slot) const;

  int resolution() const { return resolution_; }
  // A texture array holds this many slots; slot s is layer s % slotsAnArray() of array(s / …).
  int slotsAnArray() const { return slotsAnArray_; }
  GLuint array(int i) const { return arrays_[static_cast<size_t>(i)].name(); }
  bool hasArray(int i) const { return static_cast<size_t>(i) < arrays_.size(); }
  uint64_t bytes() const;

 private:
  struct Programs {
    Program opaque, masked;
  };
  void renderMap(const GlScene& scene, const shared::Vpl& vpl, int indexInBuffer);
  void drawFace(const GlScene& scene, const shared::Vpl& vpl, const Programs& programs,
                int indexInBuffer, const vec2* face);

  Programs hemisphere_, directional_;
  Framebuffer framebuffer_;
  std::vector<Texture> arrays_;
  std::vector<bool> isDirectional_;  // by slot: what was rendered last
  int slots_ = 0, resolution_ = 0, slotsAnArray_ = 1;
  // Kept between draws, so that drawing allocates nothing.
  std::vector<GLsizei> counts_;
  std::vector<const void*> offsets_;
};

}  // namespace lamplighter::gl
