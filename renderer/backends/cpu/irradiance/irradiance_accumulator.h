// The sum of all lights over a G-buffer, kept from frame to frame: a light that changed is taken
// away as it was and added as it is, and only tiles that show something else are summed anew. Sums
// are whole numbers (light_kernel.h), so nothing of what was can be told from the result.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "renderer/backends/cpu/irradiance/light_adder.h"
#include "renderer/base/revision.h"

namespace lamplighter::cpu {

class IrradianceAccumulator {
 public:
  // Brings E up to date. `patches`: how each patch comes by each light; null: with a look-up, or
  // without where the light has no map. `wanted`: by tile, the packets where E is wanted, a bit
  // each; empty: at all pixels. The unit in `constants` is chosen here. `leftOutBy`: by object, the
  // links of lights that do not light it; empty: none does. Where they change, forgetPlaces().
  SumCounts update(const GBuffer& gbuffer, std::span<const LightRecord> lights,
                   SumConstants constants, const PatchLights* patches,
                   std::span<const uint32_t> wanted = {}, std::span<const uint32_t> leftOutBy = {});

  // Whether it is of these, as they are now.
  bool isOf(const GBuffer& gbuffer, std::span<const LightRecord> lights, SumConstants constants,
            const PatchLights* patches) const;

  // For sums that change from frame to frame: memory to take lights away quickly (ShadowMaskCache).
  void cacheShadowMasks() { cachesMasks_ = true; }

  // To be called before a shadow map changes, with what it holds: its light may have to be taken
  // away with it.
  void mapChanges(int slot, std::span<const float> map);
  // After that, where it is rendered anew: what changed. Else all of it did.
  void mapChanged(int slot, const ShadowMapDiff& change);
  // All maps are lost.
  void forgetMaps();
  // Objects are numbered anew, or have other patches though they stayed where they were.
  void forgetPlaces() { knowsPlaces_ = false; }

  // Where one of few lights is partly hidden from a pixel's patch, so that there may be hard
  // shadows of any shape: a parallel or punctual one with more than kHardShare (low_resolution.h)
  // of the light of all parallel or all other lights.
  struct HardShadows {
    bool hasLights = true;    // there are such lights, or it is not known
    std::vector<uint8_t> at;  // by pixel of the G-buffer, 1 or 0
  };
  HardShadows findHardShadows() const;

  // E at a pixel of the G-buffer, where it was wanted [W/m²].
  vec3 irradiance(size_t i) const { return {red_[i], green_[i], blue_[i]}; }
  // A channel of it there and at the pixels that follow in the G-buffer.
  const float* red(size_t i) const { return &red_[i]; }
  const float* green(size_t i) const { return &green_[i]; }
  const float* blue(size_t i) const { return &blue_[i]; }
  size_t bytes() const;

 private:
  struct Tile {
    uint64_t revision = 0;  // of the G-buffer's tile, as summed; 0: never
    uint32_t summed = 0;    // packets, of the lights as they were
    uint32_t wanted = 0;    // packets; those that are summed go on from there, others begin anew
    TilePlaces places;
    ShadowMaskCache lit;  // of what is summed
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

  bool knowsSums_ = false;    // those that are summed are of lights_ with constants_
  bool knowsPlaces_ = false;  // of tiles that show the same
  bool hasPatches_ = false, hasMaps_ = false, hasTransfer_ = false;
  SumConstants constants_;
  std::vector<LightRecord> lights_;  // as summed
  struct OldMap {
    std::vector<float> texels;  // as summed; none where notes of what is lit are kept
    ShadowMapDiff change;
    bool isChangedOnce = true;
  };
  std::map<int, OldMap> oldMaps_;  // by slot, of those that changed since
  bool cachesMasks_ = false;
  bool masksAreCached_ = false;
  size_t maskSlots_ = 0;
  PlaceTable table_;
  std::vector<Tile> tiles_;
  std::vector<Revision> mapRevisions_;       // of light maps, by object
  std::vector<Revision> transferRevisions_;  // of light by transfer, likewise
  Revision coverage_;                        // of which objects have it
  FixedSums sums_;
  std::vector<float> red_, green_, blue_;
};

}  // namespace lamplighter::cpu
