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
#include "renderer/backends/many_lights_kernels.h"

namespace lamplighter::cpu {

class MapStore {
 public:
  // Like ManyLightsKernels::reserveShadowMaps(). Returns whether all maps were lost.
  bool reserve(int slots, const MapRoom& coarse, const MapRoom& fine);
  // Call before render() when shadow casters changed or moved.
  void castersChange();
  void castersMove(const RenderScene& scene, const RenderSceneChanges& changes);

  // Renders the map of each light for its slot. `changes`, one per light,
  // receives the part of the map that changed; all of it, if the slot had no map of this size or
  // the light moved. Throws InputError if memory is short. Returns the number of rays.
  uint64_t render(const RenderScene& scene, const RayCaster& rays,
                  std::span<const shared::Vpl> lights, MapSize size,
                  std::span<ShadowMapDiff> changes);
  void drop(int slot);

  // Row by row; empty: the slot has no map.
  std::span<const float> map(int slot) const {
    return slot < 0 ? std::span<const float>() : texelsOf(maps_[static_cast<size_t>(slot)]);
  }
  // Resolution of the map of a slot: texels per side.
  int resolution(int slot) const {
    return slot < 0 ? 0 : of(maps_[static_cast<size_t>(slot)].size).resolution();
  }
  size_t held() const { return sizes_[0].memory.taken() + sizes_[1].memory.taken(); }
  // Memory of the maps, including the memory of dropped maps, which is reused.
  size_t bytes() const { return sizes_[0].bytes() + sizes_[1].bytes(); }

 private:
  struct Map {
    float* texels = nullptr;  // null: there is no map
    MapSize size = MapSize::coarse;
    shared::Vpl light;  // the light that the map belongs to
    std::vector<uint8_t> isTraced;
    // The number of moves that the map shows; none: it is older than castersChange().
    std::optional<uint64_t> moves;
  };
  struct Move {
    uint32_t object;
    Bounds before, after;
  };
  // The maps of one size.
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
  bool castersChanged_ = true;  // since raster_ was updated
  std::vector<uint32_t> movedSince_;
  std::vector<Move> moves_;  // the most recent ones
  uint64_t moveCount_ = 0;   // total number of moves
};

}  // namespace lamplighter::cpu
