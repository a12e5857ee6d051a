// Adds lights to some tiles' packets, or takes them away: which of the packets use a light in which
// way, and what of it is noted for when it is taken away again.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "renderer/backends/cpu/irradiance/light_kernel.h"
#include "renderer/backends/cpu/irradiance/shadow_mask_cache.h"
#include "renderer/backends/cpu/irradiance/tile_places.h"

namespace lamplighter::cpu {

struct SumCounts {
  uint64_t lightPixels = 0;  // lights × pixels, added or taken away
  uint64_t lookUps = 0;      // of those, with one in a shadow map; in whole packets
};

class LightAdder {
 public:
  // table: how each patch comes by each light; null: with a look-up, or without where the light has
  // no map. leftOutBy: as for IrradianceAccumulator::update().
  LightAdder(const GBuffer& gbuffer, const PlaceTable* table, std::span<const uint32_t> leftOutBy,
             const SumConstants& constants, SumCounts& counts)
      : gbuffer_(gbuffer),
        table_(table),
        leftOutBy_(leftOutBy),
        constants_(constants),
        counts_(counts) {}

  bool hasRoomFor(uint32_t packets) const;
  // lit: where what is lit is noted; null: it is not.
  void addPackets(int tile, uint32_t packets, const TilePlaces& places, ShadowMaskCache* lit);

  void add(const LightRecord& light, Sign sign, TilePlaces::When when);
  // All of these, those that are used alike one after the other.
  void addAll(std::span<const LightRecord* const> lights, Sign sign, TilePlaces::When when);

  // Where it is not touched by what changed of its map. One that is as bright as before need not
  // be.
  void replace(const PlaceTable::Staying& light);

  // Once all is added and taken away.
  void finish(FixedSums& sums) const { block_.addTo(sums); }

 private:
  struct Lit {
    uint8_t* ofSlot0;
    size_t stride;
  };

  void addAs(uint64_t uses, const LightRecord& light, Sign sign, TilePlaces::When when);
  void leaveOut(uint32_t link, PacketLanes& lanes) const;
  uint64_t findUses(int slot, TilePlaces::When when);
  bool listAs(uint64_t uses);
  uint8_t& noteOf(size_t packet, int slot) const;
  void findLit(const PacketList& packets, int slot, ShadowMasks& lit) const;
  void sum(const PacketList& packets, ShadowMode use, Sign sign, const LightRecord& light);

  const GBuffer& gbuffer_;
  const PlaceTable* table_;
  std::span<const uint32_t> leftOutBy_;
  const SumConstants& constants_;
  SumCounts& counts_;
  PacketBlock block_;
  std::vector<Lit> lit_;  // by packet of the block; or none, where it is not noted
  uint64_t pixels_ = 0;
  std::vector<uint32_t> rows_;       // of the table, in these tiles
  std::vector<PacketLanes> inRows_;  // what lies in each of them
  std::vector<ShadowMode> uses_;     // by rows_, of the light that was asked for last
  uint64_t listedUses_ = 0;          // that lists_ are for; 0: none
  PacketList lists_[4];              // by ShadowMode
  std::vector<std::pair<uint64_t, const LightRecord*>> order_;
};

}  // namespace lamplighter::cpu
