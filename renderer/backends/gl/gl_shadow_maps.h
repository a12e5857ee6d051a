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

  // Of all slots at most `most` have a map at a time. Throws InputError when the device can't hold
  // them.
  void reserve(int slots, int resolution, int most);
  void render(const GlScene& scene, std::span<const shared::Vpl> vpls, const VplBuffer& buffer);
  void drop(std::span<const int> slots);
  std::vector<float> read(int slot) const;  // empty: it has no map

  int resolution() const { return resolution_; }
  // Where a slot's map is; kNone: it has none.
  int place(int slot) const { return slot < 0 ? kNone : places_[static_cast<size_t>(slot)]; }
  // A texture array has this many places; place p is layer p % placesAnArray() of array(p / …).
  int placesAnArray() const { return placesAnArray_; }
  GLuint array(int i) const { return arrays_[static_cast<size_t>(i)].name(); }
  bool hasArray(int i) const { return static_cast<size_t>(i) < arrays_.size(); }
  uint64_t bytes() const;  // of all places, in use or not
  int held() const { return held_; }

 private:
  struct Programs {
    Program opaque, masked;
  };
  void givePlace(int slot);
  void grow(int places);
  Texture makeArray(int layers) const;
  void renderMap(const GlScene& scene, const shared::Vpl& vpl, int indexInBuffer);
  void drawFace(const GlScene& scene, const shared::Vpl& vpl, const Programs& programs,
                int indexInBuffer, const vec2* face);

  Programs hemisphere_, directional_;
  Framebuffer framebuffer_;
  std::vector<Texture> arrays_;      // all but the last are full
  std::vector<int> places_;          // by slot
  std::vector<int> free_;            // places that nobody has, the last first
  std::vector<bool> isDirectional_;  // by slot: what was rendered last
  int resolution_ = 0, most_ = 0, placesAnArray_ = 1;
  int room_ = 0;  // places that the arrays have
  int held_ = 0;
  // Kept between draws, so that drawing allocates nothing.
  std::vector<GLsizei> counts_;
  std::vector<const void*> offsets_;
};

}  // namespace lamplighter::gl
