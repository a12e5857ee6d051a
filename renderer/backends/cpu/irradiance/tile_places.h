// The leaf patches in which the pixels of a tile lie, and the shadow mode of each light there.
// Found once per tile and kept while the tile shows the same.
#pragma once

#include <array>
#include <bit>
#include <compare>
#include <map>
#include <vector>

#include "renderer/backends/cpu/irradiance/light_kernel.h"
#include "renderer/backends/cpu/irradiance/shadow_map_diff.h"

namespace lamplighter::cpu {

// Pixels for which every light has the same shadow mode.
struct Place {
  uint32_t object = 0;
  int leaf = 0;
  bool isMapped = false;  // they start from the light map or from radiance transfer
  auto operator<=>(const Place&) const = default;
};

// The shadow mode of each light in each visible place, now and as used in the sums.
class PlaceTable {
 public:
  // Forgets all places.
  void reset(size_t slots);
  uint32_t rowOf(const Place& place);
  size_t rows() const { return places_.size(); }
  size_t slots() const { return slots_; }

  // Updates the rows in use. Other rows are forgotten: their patches may no longer exist.
  void update(const PatchLights& lights, const std::vector<bool>& inUse);
  const ShadowMode* now(uint32_t row) const { return now_.data() + row * slots_; }
  const ShadowMode* before(uint32_t row) const { return before_.data() + row * slots_; }
  // Slots whose shadow mode changed.
  std::span<const int> changed(uint32_t row) const { return changed_[row]; }

  // A light that did not move since it was summed. Its brightness, and a part of its map, may have
  // changed.
  struct Staying {
    const LightRecord *was, *is;
    ShadowMapDiff change;  // empty or partial
    bool isReplaced() const { return was->intensity != is->intensity; }
  };
  // Finds the rows in which these lights must be subtracted and added again. In other rows a light
  // is unchanged, or only its brightness changed and its shadow mask is still valid. Valid until
  // accept().
  void findTouched(std::span<const Staying> lights);
  // By row, 1 or 0: whether it is such a row; null: the light is none of these, so any row may be
  // affected.
  const uint8_t* touched(int slot) const {
    return static_cast<size_t>(slot) < touched_.size() &&
                   !touched_[static_cast<size_t>(slot)].empty()
               ? touched_[static_cast<size_t>(slot)].data()
               : nullptr;
  }
  // The present state is now the one used in the sums.
  void accept();
  size_t bytes() const { return now_.size() + before_.size(); }

 private:
  size_t slots_ = 0;
  std::map<Place, uint32_t> rowOf_;
  std::vector<Place> places_;
  std::vector<ShadowMode> now_, before_;       // rows × slots
  std::vector<std::vector<int>> changed_;      // slots, by row
  std::vector<uint8_t> isKnown_;               // by row: before_ holds what was summed
  PlaceSpheres spheres_;                       // of rows in use
  std::vector<std::vector<uint8_t>> touched_;  // by slot; empty: unknown
};

// The places of one tile. Packets whose lanes lie in the same places are of one kind; a tile has
// few kinds.
class TilePlaces {
 public:
  // Call when the tile shows something else.
  void clear();
  // Finds the places of these packets (one bit each), unless they are known. patches: null if all
  // lights need a look-up everywhere.
  void find(const GBuffer& gbuffer, int tile, const PatchLights* patches, uint32_t packets);
  bool knows(uint32_t packets) const { return (packets & ~known_) == 0; }
  // Gets their rows in the table. Call after find(), not concurrently with other tiles.
  void takeRows(PlaceTable& table);

  // Known packets that hit something.
  uint32_t hit() const { return hit_; }
  std::span<const uint32_t> rows() const { return rows_; }
  // Which shadow mode: the old or new one where the row is touched, the one where it is untouched,
  // or the new one everywhere.
  enum class When : uint8_t { before, after, untouched, now };
  // Calls f(packet, lanes, row in the table, 0 if none) for all places of these packets.
  template <typename F>
  void forEachPart(uint32_t which, F&& f) const {
    for (const Kind& kind : kinds_)
      for (size_t part = kind.first; part < kind.first + kind.count; ++part)
        for (uint32_t packets = kind.packets & which; packets != 0; packets &= packets - 1)
          f(std::countr_zero(packets), parts_[part].lanes,
            rows_.empty() ? 0 : rows_[parts_[part].place]);
  }

  // Calls f(first pixel of the packet, lanes, row in the table) for all known packets.
  template <typename F>
  void forEachRow(F&& f) const {
    for (const Kind& kind : kinds_)
      for (size_t part = kind.first; part < kind.first + kind.count; ++part)
        for (uint32_t packets = kind.packets; packets != 0; packets &= packets - 1)
          f(first_ + static_cast<size_t>(std::countr_zero(packets)) * kLanes, parts_[part].lanes,
            rows_[parts_[part].place]);
  }

  // Calls f(first pixel of the packet, lanes, place) for all lanes of these packets that start from
  // a light map or from transfer.
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
    uint32_t packets;       // one bit each
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
