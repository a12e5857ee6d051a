// The shadow maps of the cpu backend, by slot.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/backends/cpu/map_change.h"
#include "renderer/backends/cpu/shadow_raster.h"

namespace lamplighter::cpu {

class MapStore {
 public:
  // As Backend::reserveShadowMaps(). Whether all maps were lost.
  bool reserve(int slots, int resolution, int most);
  // What casts shadows may be anything else, or some of it moved; to be told before render().
  void castersChange();
  void castersMove(const RenderScene& scene, const RenderSceneChanges& changes);

  // Renders the maps of these lights, each for the slot in its intensity.w. `changes`, one for
  // each: what of its map changed; everything, where it had none or was elsewhere. Throws
  // InputError where there is no memory. The number of rays that were cast.
  uint64_t render(const RenderScene& scene, const RayCaster& rays,
                  std::span<const shared::Vpl> lights, std::span<MapChange> changes);
  void drop(int slot);

  // Row after row; empty: there is none.
  std::span<const float> map(int slot) const {
    return slot < 0 ? std::span<const float>() : maps_[static_cast<size_t>(slot)].texels;
  }
  int resolution() const { return resolution_; }
  size_t held() const { return held_; }
  size_t bytes() const { return held_ * texels() * sizeof(float); }

 private:
  struct Map {
    std::vector<float> texels;  // none: there is no map
    shared::Vpl light;          // whose it is
    std::vector<uint8_t> isTraced;
    // Those of all moves that it shows; none: it shows what was before castersChange().
    std::optional<uint64_t> moves;
  };
  struct Move {
    uint32_t object;
    Bounds before, after;
  };
  size_t texels() const { return static_cast<size_t>(resolution_) * resolution_; }
  void make(Map& map);
  std::vector<uint8_t> outdated(const Map& map) const;
  uint64_t render(const RayCaster& rays, const shared::Vpl& light, bool isNew, Map& map,
                  MapChange& change);

  int resolution_ = 0, most_ = 0;
  std::vector<Map> maps_;
  size_t held_ = 0;
  ShadowRaster raster_;
  bool castersChanged_ = true;  // since raster_ knows of them
  std::vector<uint32_t> movedSince_;
  std::vector<Move> moves_;  // the last of all
  uint64_t moveCount_ = 0;   // of all
};

}  // namespace lamplighter::cpu
