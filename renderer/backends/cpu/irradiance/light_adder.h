// Adds lights to the packets of some tiles, or subtracts them. It finds the shadow mode of each
// light in each packet, and records in the shadow mask cache where the light was added.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "renderer/backends/cpu/irradiance/light_kernel.h"
#include "renderer/backends/cpu/irradiance/shadow_mask_cache.h"
#include "renderer/backends/cpu/irradiance/tile_places.h"

namespace lamplighter::cpu {

struct SumCounts {
  uint64_t lightPixels = 0;  // lights × pixels, added or subtracted
  uint64_t lookUps = 0;      // of these, with a shadow map look-up; counted in whole packets
};
inline SumCounts operator+(const SumCounts& a, const SumCounts& b) {
  return {a.lightPixels + b.lightPixels, a.lookUps + b.lookUps};
}

class LightAdder {
 public:
  // table: the shadow mode of each light on each patch; null: a look-up, or none if the light has
  // no map. leftOutBy: as for IrradianceAccumulator::update().
  LightAdder(const GBuffer& gbuffer, const PlaceTable* table, std::span<const uint32_t> leftOutBy,
             const SumConstants& constants, SumCounts& counts)
      : gbuffer_(gbuffer),
        table_(table),
        leftOutBy_(leftOutBy),
        constants_(constants),
        counts_(counts) {
    if (constants.isFine) block_.sumFinely();
  }

  bool hasRoomFor(uint32_t packets) const;
  // lit: the cache that records where lights are added; null: not recorded.
  void addPackets(int tile, uint32_t packets, const TilePlaces& places, ShadowMaskCache* lit);

  void add(const LightRecord& light, Sign sign, TilePlaces::When when);
  // Adds or subtracts all these lights. Lights with the same shadow modes are processed one after
  // another.
  void addAll(std::span<const LightRecord* const> lights, Sign sign, TilePlaces::When when);

  // Updates the brightness of a light where the change of its map has no effect. Not needed if the
  // brightness is the same.
  void replace(const PlaceTable::Staying& light);

  // Call once after everything is added and subtracted.
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
  std::vector<Lit> lit_;  // by packet of the block; empty if nothing is recorded
  uint64_t pixels_ = 0;
  std::vector<uint32_t> rows_;       // rows of the table in these tiles
  std::vector<PacketLanes> inRows_;  // the lanes that lie in each of them
  std::vector<ShadowMode> uses_;     // by rows_, for the light of the last request
  uint64_t listedUses_ = 0;          // the shadow modes that lists_ belong to; 0: none
  PacketList lists_[4];              // by ShadowMode
  std::vector<std::pair<uint64_t, const LightRecord*>> order_;
};

}  // namespace lamplighter::cpu
