// What one light gives the pixels of a tile, with or without a look-up in its shadow map: the inner
// loop of everything, eight pixels at a time.
//
// Irradiance is summed in whole numbers: each contribution is rounded to a multiple of a unit and
// added as an integer. So lights may come and go in any order, and what is left has the very bits
// of a sum made from nothing (irradiance_accumulator.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/irradiance/packet_block.h"
#include "renderer/light_maps/patch_lights.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::cpu {

// A VPL made ready for the inner loop.
struct LightRecord {
  enum class Kind : uint8_t { cosine, uniform, directional };
  Kind kind = Kind::cosine;
  const float* map = nullptr;  // null: casts no shadow
  int slot = -1;
  int mapSlot = -1;    // whose map it is
  int resolution = 1;  // of it, texels a side
  vec3 position, normal, tangent, bitangent, intensity;
  float coneScale = 0.0f, coneOffset = 1.0f;
  float radius = 0.0f, side = 1.0f;  // directional: R and S
  uint32_t link = 0;                 // renderer/scene/light_linking.h
  bool operator==(const LightRecord&) const = default;
  // But for its intensity.
  bool isInPlaceOf(LightRecord other) const {
    other.intensity = intensity;
    return *this == other;
  }
};

// With a map of resolution², or null.
LightRecord makeLightRecord(const shared::Vpl& vpl, const float* map, int resolution);

struct SumConstants {
  float clampDistance2 = 0.0f;  // d0² [m²]
  float bias = 0.0f;
  float unitsPerIrradiance = 1.0f;  // a power of two [m²/W]
  bool operator==(const SumConstants&) const = default;
};

// Which lanes of the packets of a block are meant, a byte each.
struct alignas(32) PacketLanes {
  std::array<uint8_t, PacketBlock::kMost> of{};
  void add(const PacketLanes& more);
};

// Those of these packets of which any lane is meant, in order.
class PacketList {
 public:
  void take(const PacketLanes& lanes);
  size_t count() const { return count_; }
  size_t packet(size_t k) const { return packet_[k]; }
  const uint8_t* lanes(size_t k) const { return &lanes_.of[packet_[k]]; }

 private:
  static_assert(PacketBlock::kMost <= 256);
  PacketLanes lanes_;
  std::array<uint8_t, PacketBlock::kMost> packet_;
  size_t count_ = 0;
};

enum class Sign : uint8_t { add, takeAway };

// Of each packet of a list, the lanes in which a light gives or takes something.
using ShadowMasks = std::array<uint8_t, PacketBlock::kMost>;

// Adds what the light gives these pixels by `use` (not skip) to the block's sums, or takes it away
// again. Where it looks its shadow map up, `lit` tells afterwards what addMasked() takes.
void addLight(PacketBlock& block, const PacketList& packets, ShadowMode use, Sign sign,
              const LightRecord& light, const SumConstants& constants, ShadowMasks& lit);

// The same, for a light that adds or takes its shadow in those lanes, without a look-up.
void addMasked(PacketBlock& block, const PacketList& packets, ShadowMode use, Sign sign,
               const LightRecord& light, const SumConstants& constants, const ShadowMasks& lit);

// Takes it away in those lanes as it was before, and adds it as it is now: it differs in nothing
// but its intensity.
void replaceMasked(PacketBlock& block, const PacketList& packets, ShadowMode use,
                   const LightRecord& before, const LightRecord& now, const SumConstants& constants,
                   const ShadowMasks& lit);

}  // namespace lamplighter::cpu
