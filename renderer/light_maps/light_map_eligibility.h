// Which lights a light map's tile can hold.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/patches/charts.h"
#include "renderer/patches/patch_set.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// Where a tile's patch is.
struct TilePlace {
  const Chart& chart;
  const Patch& patch;
  float spacing;  // of its texels [m]
  vec3 corners[4];

  TilePlace(const Chart& c, const Patch& p, float texelSpacing)
      : chart(c),
        patch(p),
        spacing(texelSpacing),
        corners{c.at(p.min), c.at({p.max.x, p.min.y}), c.at(p.max), c.at({p.min.x, p.max.y})} {}
};

// Whether a light is smooth enough over the patch to be interpolated, and not too bright to be
// summed.
bool isLightMapEligible(const shared::Vpl& vpl, const TilePlace& tile, float clampDistance);

// The same for many lights and tile after tile, eight lights at a time.
class EligibleLights {
 public:
  // slots: of the lights to be asked for.
  EligibleLights(std::span<const shared::Vpl> bySlot, std::span<const uint32_t> slots,
                 float clampDistance);
  // Sets their bits, 64 slots a word, and leaves all others.
  void find(const TilePlace& tile, std::span<uint64_t> bits) const;

 private:
  std::span<const shared::Vpl> bySlot_;
  float clampDistance_;
  std::vector<uint32_t> others_;  // slots of parallel light and of spots
  // Lights that shine from a point, in whole vectors, and their slots.
  std::vector<uint32_t> slots_;
  std::vector<float> px_, py_, pz_, nx_, ny_, nz_;
  std::vector<float> brightest_, least_;  // least: what a squared distance is raised to
};

}  // namespace lamplighter
