// The irradiance of all lights over a G-buffer, kept from frame to frame. For a changed light the
// old state is subtracted and the new one is added; only tiles that show other surfaces are summed
// from scratch. Sums are integers (light_kernel.h), so the result does not depend on the history.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "renderer/backends/cpu/irradiance/light_adder.h"
#include "renderer/base/revision.h"

namespace lamplighter::cpu {

class IrradianceAccumulator {
 public:
  // Updates E. `patches`: the shadow mode of each light on each patch; null: a shadow map look-up,
  // or none if the light has no map. `wanted`: by tile, the packets where E is wanted, one bit
  // each; empty: all pixels. Chooses the unit in `constants`. `leftOutBy`: by object, the link bits
  // of the lights that do not light it (light linking); empty: all lights light all objects. Call
  // forgetPlaces() when the links change.
  SumCounts update(const GBuffer& gbuffer, std::span<const LightRecord> lights,
                   SumConstants constants, const PatchLights* patches,
                   std::span<const uint32_t> wanted = {}, std::span<const uint32_t> leftOutBy = {});

  // Whether E is up to date for these arguments.
  bool isOf(const GBuffer& gbuffer, std::span<const LightRecord> lights, SumConstants constants,
            const PatchLights* patches) const;

  // What an update to these lights would cost, for choosing how much is wanted: the lights that it
  // adds and subtracts at a packet that is summed.
  size_t changesTo(std::span<const LightRecord> lights) const;
  // The packets of a tile that are summed, one bit each.
  uint32_t summed(const GBuffer& gbuffer, size_t tile) const;

  // For sums that change from frame to frame: uses memory to subtract lights quickly
  // (ShadowMaskCache).
  void cacheShadowMasks() { cachesMasks_ = true; }

  // Call before a shadow map changes, with its present content: it may be needed to subtract the
  // light.
  void mapChanges(int slot, std::span<const float> map);
  // Call afterwards if the map was rendered again, with the difference. Without it the whole map
  // counts as changed.
  void mapChanged(int slot, const ShadowMapDiff& change);
  // All maps are lost.
  void forgetMaps();
  // Call when objects are renumbered, or get other patches without moving.
  void forgetPlaces() { knowsPlaces_ = false; }

  // Pixels that may have hard shadows of any shape: a strong light is partly hidden from the
  // pixel's patch. A strong light is a directional or punctual one with more than kHardShare
  // (low_resolution.h) of the light of all directional lights, or of all others.
  struct HardShadows {
    bool hasLights = true;    // there are strong lights, or this is not known
    std::vector<uint8_t> at;  // by G-buffer pixel, 1 or 0
  };
  HardShadows findHardShadows() const;

  // E at a G-buffer pixel where it was wanted [W/m²].
  vec3 irradiance(size_t i) const { return {red_[i], green_[i], blue_[i]}; }
  // One channel of E, at this pixel and the following ones.
  const float* red(size_t i) const { return &red_[i]; }
  const float* green(size_t i) const { return &green_[i]; }
  const float* blue(size_t i) const { return &blue_[i]; }
  size_t bytes() const;

 private:
  struct Tile {
    uint64_t revision = 0;  // of the G-buffer tile when it was summed; 0: never
    uint32_t summed = 0;    // packets with valid sums of the previous lights
    uint32_t wanted = 0;  // packets; those in `summed` are updated, others are summed from scratch
    TilePlaces places;
    ShadowMaskCache lit;  // for the packets that are summed
    uint32_t kept() const { return wanted & summed; }
    uint32_t begun() const { return wanted & ~summed; }
  };
  struct Frame;

  void compareWithLast(const Frame& frame);
  bool isMost(size_t changed, size_t all) const;
  void findChanges(Frame& frame);
  bool fitMasks(const Frame& frame);
  void keepMasks();
  void findPlaces(const Frame& frame);
  SumCounts sumTiles(const Frame& frame, int first, int last);
  void clearPackets(int tile, uint32_t packets);
  void finishTile(const Frame& frame, int tile);

  bool knowsSums_ = false;    // the sums of summed packets belong to lights_ and constants_
  bool knowsPlaces_ = false;  // of tiles whose content did not change
  bool hasPatches_ = false, hasMaps_ = false, hasTransfer_ = false;
  SumConstants constants_;
  std::vector<LightRecord> lights_;  // as used in the sums
  struct OldMap {
    std::vector<float> texels;  // as used in the sums; empty if the shadow mask cache is used
    ShadowMapDiff change;
    bool isChangedOnce = true;
  };
  std::map<int, OldMap> oldMaps_;  // by slot: maps that changed since the last update
  bool cachesMasks_ = false;
  bool masksAreCached_ = false;
  size_t maskSlots_ = 0;
  PlaceTable table_;
  std::vector<Tile> tiles_;
  std::vector<Revision> mapRevisions_;       // of light maps, by object
  std::vector<Revision> transferRevisions_;  // of radiance transfer, by object
  Revision mapCoverage_;                     // of the set of patches with light maps
  Revision coverage_;                        // of the set of objects with radiance transfer
  FixedSums sums_;
  std::vector<float> red_, green_, blue_;
};

}  // namespace lamplighter::cpu
