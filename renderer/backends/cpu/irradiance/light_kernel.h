// The irradiance of one light at the pixels of a tile, with or without a shadow map look-up. This
// is the innermost loop of the renderer; it processes eight pixels at a time.
//
// Irradiance is summed in integers: each contribution is rounded to a multiple of a unit. So lights
// can be added and subtracted in any order, and the sum has the same bits as one computed from
// scratch (irradiance_accumulator.h). If there are many or dim lights, their rounding errors are
// summed in a second integer: the light of a candle in a dark room beside a sunlit one can be less
// than a unit for each of thousands of light samples.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/irradiance/packet_block.h"
#include "renderer/light_maps/patch_lights.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::cpu {

// A VPL prepared for the innermost loop.
struct LightRecord {
  enum class Kind : uint8_t { cosine, uniform, directional };
  Kind kind = Kind::cosine;
  const float* map = nullptr;  // null: casts no shadow
  int slot = -1;
  int mapSlot = -1;    // slot of the light whose map is used
  int resolution = 1;  // of the map, texels per side
  vec3 position, normal, tangent, bitangent, intensity;
  float coneScale = 0.0f, coneOffset = 1.0f;
  float radius = 0.0f, side = 1.0f;  // directional: R and S
  uint32_t link = 0;                 // renderer/scene/light_linking.h
  bool operator==(const LightRecord&) const = default;
  // Whether they differ only in intensity.
  bool isInPlaceOf(LightRecord other) const {
    other.intensity = intensity;
    return *this == other;
  }
};

// `map` has resolution² texels, or is null.
LightRecord makeLightRecord(const shared::Vpl& vpl, const float* map, int resolution);

struct SumConstants {
  float clampDistance2 = 0.0f;  // d0² [m²]
  float bias = 0.0f;
  float unitsPerIrradiance = 1.0f;  // a power of two [m²/W]
  bool isFine = false;              // sums have a second part, in FixedSums::kFinePerUnit of a unit
  bool operator==(const SumConstants&) const = default;
};

// The selected lanes of the packets of a block, one byte per packet.
struct alignas(32) PacketLanes {
  std::array<uint8_t, PacketBlock::kMost> of{};
  void add(const PacketLanes& more);
};

// The packets that have at least one selected lane, in order.
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

// By packet of a list: the lanes where a light contributes.
using ShadowMasks = std::array<uint8_t, PacketBlock::kMost>;

// Adds the contribution of the light at these pixels, in shadow mode `use` (not skip), to the sums
// of the block, or subtracts it. If it reads the shadow map, `lit` receives the lanes that
// addMasked() needs.
void addLight(PacketBlock& block, const PacketList& packets, ShadowMode use, Sign sign,
              const LightRecord& light, const SumConstants& constants, ShadowMasks& lit);

// The same without a look-up: the light, or its shadow, contributes in the given lanes.
void addMasked(PacketBlock& block, const PacketList& packets, ShadowMode use, Sign sign,
               const LightRecord& light, const SumConstants& constants, const ShadowMasks& lit);

// Subtracts the old light and adds the new one in these lanes. They differ only in intensity.
void replaceMasked(PacketBlock& block, const PacketList& packets, ShadowMode use,
                   const LightRecord& before, const LightRecord& now, const SumConstants& constants,
                   const ShadowMasks& lit);

}  // namespace lamplighter::cpu
