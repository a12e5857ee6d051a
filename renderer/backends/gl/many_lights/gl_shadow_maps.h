// Octahedral hemisphere shadow maps (paper 1, 4.2), rasterised into depth texture arrays.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include "renderer/backends/gl/gl_scene.h"
#include "renderer/backends/gl/many_lights/vpl_buffer.h"
#include "renderer/backends/many_lights_kernels.h"
#include "renderer/gl/program.h"

namespace lamplighter::gl {

class GlShadowMaps {
 public:
  GlShadowMaps(const std::filesystem::path& shaders, const VplBuffer& vpls);
  void reload(const std::filesystem::path& shaders, const VplBuffer& vpls);

  // Like ManyLightsKernels::reserveShadowMaps().
  void reserve(int slots, const MapRoom& coarse, const MapRoom& fine);
  void render(const GlScene& scene, std::span<const shared::Vpl> vpls, MapSize size,
              const VplBuffer& buffer);
  void drop(std::span<const int> slots);
  std::vector<float> read(Waits& waits, int slot) const;  // empty: the slot has no map

  // The location of a slot's map.
  struct Place {
    int array = 0, layer = kNone;  // kNone: no map
  };
  Place place(int slot) const;
  // Texture arrays; arrays of coarse maps have even indices, those of fine maps odd ones.
  bool hasArray(int i) const { return static_cast<size_t>(i / 2) < poolOf(i).arrays.size(); }
  GLuint array(int i) const { return poolOf(i).arrays[static_cast<size_t>(i / 2)].name(); }
  int resolution(int i) const { return poolOf(i).room.resolution; }  // of the maps in array i
  uint64_t bytes() const { return pools_[0].bytes() + pools_[1].bytes(); }
  int held() const { return pools_[0].held + pools_[1].held; }

 private:
  struct Programs {
    Program opaque, masked;
  };
  // Maps of one size. Place p is layer p % placesAnArray of array p / placesAnArray.
  struct Pool {
    MapRoom room;
    int placesAnArray = 1;
    std::vector<Texture> arrays;  // all except the last are full
    std::vector<int> free;        // unused places, the last one first
    int space = 0;                // number of places in the arrays
    int held = 0;
    uint64_t mapBytes() const { return uint64_t{4} * room.resolution * room.resolution; }
    uint64_t bytes() const { return mapBytes() * space; }  // of all places, used or not
  };
  struct Slot {
    MapSize size = MapSize::coarse;
    int place = kNone;           // in the pool of its size
    bool isDirectional = false;  // kind of the last rendered map
  };
  const Pool& poolOf(int array) const { return pools_[static_cast<size_t>(array % 2)]; }
  Pool& poolOf(MapSize size) { return pools_[static_cast<size_t>(size)]; }
  void givePlace(Slot& slot, MapSize size);
  void drop(Slot& slot);
  static void grow(Pool& pool, int places);
  static Texture makeArray(const Pool& pool, int layers);
  void renderMap(const GlScene& scene, const shared::Vpl& vpl, int indexInBuffer);
  void drawFace(const GlScene& scene, const shared::Vpl& vpl, const Programs& programs,
                int indexInBuffer, const vec2* face, int resolution);

  Programs hemisphere_, directional_;
  Framebuffer framebuffer_;
  std::array<Pool, 2> pools_;  // by MapSize
  std::vector<Slot> slots_;
  // Members, so that drawing allocates no memory.
  std::vector<GLsizei> counts_;
  std::vector<const void*> offsets_;
};

}  // namespace lamplighter::gl
