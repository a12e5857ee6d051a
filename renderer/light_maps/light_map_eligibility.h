// Which lights the tile of a light map can hold.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/patches/charts.h"
#include "renderer/patches/patch_set.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// The position of a tile's patch.
struct TilePlace {
  const Chart& chart;
  const Patch& patch;
  float spacing;  // between texels [m]
  vec3 corners[4];

  TilePlace(const Chart& c, const Patch& p, float texelSpacing)
      : chart(c),
        patch(p),
        spacing(texelSpacing),
        corners{c.at(p.min), c.at({p.max.x, p.min.y}), c.at(p.max), c.at({p.min.x, p.max.y})} {}
};

// Whether the irradiance of a light varies slowly enough over the patch to be interpolated, and is
// not too large for the fixed-point sums.
bool isLightMapEligible(const shared::Vpl& vpl, const TilePlace& tile, float clampDistance);

// The same for many lights, one tile after another, eight lights at a time.
class EligibleLights {
 public:
  // slots: the lights to test.
  EligibleLights(std::span<const shared::Vpl> bySlot, std::span<const uint32_t> slots,
                 float clampDistance);
  // Sets the bits of these lights in `bits` (64 slots per word); other bits keep their values.
  void find(const TilePlace& tile, std::span<uint64_t> bits) const;

 private:
  std::span<const shared::Vpl> bySlot_;
  float clampDistance_;
  std::vector<uint32_t> others_;  // slots of directional lights and of spot lights
  // Point-like lights, padded to whole vectors, and their slots.
  std::vector<uint32_t> slots_;
  std::vector<float> px_, py_, pz_, nx_, ny_, nz_;
  std::vector<float> brightest_, least_;  // least: the lower bound of a squared distance
};

}  // namespace lamplighter
