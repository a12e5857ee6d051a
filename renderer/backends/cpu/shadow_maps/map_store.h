// The shadow maps of the cpu backend, by slot.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/backends/cpu/irradiance/shadow_map_diff.h"
#include "renderer/backends/cpu/shadow_maps/map_memory.h"
#include "renderer/backends/cpu/shadow_maps/shadow_raster.h"
#include "renderer/backends/kernels.h"

namespace lamplighter::cpu {

class MapStore {
 public:
  // As Backend::reserveShadowMaps(). Whether all maps were lost.
  bool reserve(int slots, const MapRoom& coarse, const MapRoom& fine);
  // What casts shadows may be anything else, or some of it moved; to be told before render().
  void castersChange();
  void castersMove(const RenderScene& scene, const RenderSceneChanges& changes);

  // Renders the maps of these lights, each for the slot in its intensity.w. `changes`, one for
  // each: what of its map changed; everything, where it had none of this size or was elsewhere.
  // Throws InputError where there is no memory. The number of rays that were cast.
  uint64_t render(const RenderScene& scene, const RayCaster& rays,
                  std::span<const shared::Vpl> lights, MapSize size,
                  std::span<ShadowMapDiff> changes);
  void drop(int slot);

  // Row after row; empty: there is none.
  std::span<const float> map(int slot) const {
    return slot < 0 ? std::span<const float>() : texelsOf(maps_[static_cast<size_t>(slot)]);
  }
  // Of the map that a slot has, texels a side.
  int resolution(int slot) const {
    return slot < 0 ? 0 : of(maps_[static_cast<size_t>(slot)].size).resolution();
  }
  size_t held() const { return sizes_[0].memory.taken() + sizes_[1].memory.taken(); }
  // Of those. What those that were dropped had is kept for others.
  size_t bytes() const { return sizes_[0].bytes() + sizes_[1].bytes(); }

 private:
  struct Map {
    float* texels = nullptr;  // null: there is no map
    MapSize size = MapSize::coarse;
    shared::Vpl light;  // whose it is
    std::vector<uint8_t> isTraced;
    // Those of all moves that it shows; none: it shows what was before castersChange().
    std::optional<uint64_t> moves;
  };
  struct Move {
    uint32_t object;
    Bounds before, after;
  };
  // Maps of one size.
  struct Size {
    MapRoom room;
    MapMemory memory;
    ShadowMapGrid grid;
    int resolution() const { return room.resolution; }
    size_t bytes() const { return memory.taken() * memory.texelsOfMap() * sizeof(float); }
  };
  const Size& of(MapSize size) const { return sizes_[static_cast<size_t>(size)]; }
  Size& of(MapSize size) { return sizes_[static_cast<size_t>(size)]; }
  std::span<float> texelsOf(const Map& map) const {
    return map.texels == nullptr ? std::span<float>()
                                 : std::span<float>(map.texels, of(map.size).memory.texelsOfMap());
  }
  void make(Map& map, MapSize size);
  void drop(Map& map);
  std::vector<uint8_t> outdated(const Map& map) const;
  uint64_t render(const RayCaster& rays, const shared::Vpl& light, bool isNew, Map& map,
                  ShadowMapDiff& change);

  std::array<Size, 2> sizes_;
  std::vector<Map> maps_;
  ShadowRaster raster_;
  bool castersChanged_ = true;  // since raster_ knows of them
  std::vector<uint32_t> movedSince_;
  std::vector<Move> moves_;  // the last of all
  uint64_t moveCount_ = 0;   // of all
};

}  // namespace lamplighter::cpu
