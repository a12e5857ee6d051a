// Where the pixels of a tile lie: in which leaf patches, and what each of these makes of each
// light. Found once for a tile and kept while it shows the same.
#pragma once

#include <array>
#include <bit>
#include <compare>
#include <map>
#include <vector>

#include "renderer/backends/cpu/irradiance/light_kernel.h"
#include "renderer/backends/cpu/irradiance/shadow_map_diff.h"

namespace lamplighter::cpu {

// Pixels for which all lights are used alike.
struct Place {
  uint32_t object = 0;
  int leaf = 0;
  bool isMapped = false;  // they begin with the light map, or with light by transfer
  auto operator<=>(const Place&) const = default;
};

// How each light is used in each place that is seen, now and as it was summed last.
class PlaceTable {
 public:
  // Forgets all places.
  void reset(size_t slots);
  uint32_t rowOf(const Place& place);
  size_t rows() const { return places_.size(); }
  size_t slots() const { return slots_; }

  // Brings the rows in use up to date. The others are forgotten: their patches may be gone.
  void update(const PatchLights& lights, const std::vector<bool>& inUse);
  const ShadowMode* now(uint32_t row) const { return now_.data() + row * slots_; }
  const ShadowMode* before(uint32_t row) const { return before_.data() + row * slots_; }
  // Slots that are used in another way than before.
  std::span<const int> changed(uint32_t row) const { return changed_[row]; }

  // A light that is where it was when it was summed; how bright it is and a part of its map may
  // have changed.
  struct Staying {
    const LightRecord *was, *is;
    ShadowMapDiff change;  // nothing, or a part
    bool isReplaced() const { return was->intensity != is->intensity; }
  };
  // Finds the rows in which these are to be taken away and added again. In others they are the same
  // or, where they are replaced, lit as they were. Until accept().
  void findTouched(std::span<const Staying> lights);
  // By row, whether it is one of them, 1 or 0; null: the light is none of these, any row may be.
  const uint8_t* touched(int slot) const {
    return static_cast<size_t>(slot) < touched_.size() &&
                   !touched_[static_cast<size_t>(slot)].empty()
               ? touched_[static_cast<size_t>(slot)].data()
               : nullptr;
  }
  // What is now is what was summed.
  void accept();
  size_t bytes() const { return now_.size() + before_.size(); }

 private:
  size_t slots_ = 0;
  std::map<Place, uint32_t> rowOf_;
  std::vector<Place> places_;
  std::vector<ShadowMode> now_, before_;       // rows × slots
  std::vector<std::vector<int>> changed_;      // by row
  std::vector<uint8_t> isKnown_;               // by row: before_ is what was summed
  PlaceSpheres spheres_;                       // of rows in use
  std::vector<std::vector<uint8_t>> touched_;  // by slot; empty: none is known
};

// The places of one tile. Packets whose lanes lie in the same ones are of one kind, and few kinds
// are in a tile.
class TilePlaces {
 public:
  // Forgets what it knows, when the tile shows something else.
  void clear();
  // Finds those of these packets (a bit each), unless they are known.
  // patches: null where all lights are looked up everywhere.
  void find(const GBuffer& gbuffer, int tile, const PatchLights* patches, uint32_t packets);
  bool knows(uint32_t packets) const { return (packets & ~known_) == 0; }
  // Their rows in the table, once found. Not while other tiles do.
  void takeRows(PlaceTable& table);

  // Known packets in which anything is.
  uint32_t hit() const { return hit_; }
  std::span<const uint32_t> rows() const { return rows_; }
  // How a light is used: as it was or is where it is touched, where it is not, or anywhere.
  enum class When : uint8_t { before, after, untouched, now };
  // Calls f(packet, lanes, row in the table, 0 where there is none) for all places of these.
  template <typename F>
  void forEachPart(uint32_t which, F&& f) const {
    for (const Kind& kind : kinds_)
      for (size_t part = kind.first; part < kind.first + kind.count; ++part)
        for (uint32_t packets = kind.packets & which; packets != 0; packets &= packets - 1)
          f(std::countr_zero(packets), parts_[part].lanes,
            rows_.empty() ? 0 : rows_[parts_[part].place]);
  }

  // Calls f(first pixel of the packet, lanes, row in the table) for all that is known.
  template <typename F>
  void forEachRow(F&& f) const {
    for (const Kind& kind : kinds_)
      for (size_t part = kind.first; part < kind.first + kind.count; ++part)
        for (uint32_t packets = kind.packets; packets != 0; packets &= packets - 1)
          f(first_ + static_cast<size_t>(std::countr_zero(packets)) * kLanes, parts_[part].lanes,
            rows_[parts_[part].place]);
  }

  // Calls f(first pixel of the packet, lanes, place) for all lanes of these packets on a light map
  // or with transfer.
  template <typename F>
  void forEachMapped(uint32_t which, F&& f) const {
    for (const Kind& kind : kinds_) {
      for (size_t part = kind.first; part < kind.first + kind.count; ++part) {
        const Place& place = places_[parts_[part].place];
        if (!place.isMapped) continue;
        for (uint32_t packets = kind.packets & which; packets != 0; packets &= packets - 1)
          f(first_ + static_cast<size_t>(std::countr_zero(packets)) * kLanes, parts_[part].lanes,
            place);
      }
    }
  }

 private:
  struct Part {
    uint16_t place;
    uint8_t lanes;
    bool operator==(const Part&) const = default;
  };
  struct Kind {
    uint32_t first, count;  // parts
    uint32_t packets;       // a bit each
  };
  static_assert(kPacketsPerTile <= 32);

  uint16_t placeOf(const GBuffer& gbuffer, const PatchLights& lights, size_t pixel);

  size_t first_ = 0;              // pixel of the tile
  uint32_t known_ = 0, hit_ = 0;  // packets
  std::vector<Place> places_;
  std::vector<uint32_t> rows_;  // by place
  std::vector<Part> parts_;
  std::vector<Kind> kinds_;
};

}  // namespace lamplighter::cpu
