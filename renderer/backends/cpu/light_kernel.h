// What one light gives the pixels of a tile, with or without a look-up in its shadow map: the inner
// loop of everything, eight pixels at a time.
//
// Irradiance is summed in whole numbers: each contribution is rounded to a multiple of a unit and
// added as an integer. So lights may come and go in any order, and what is left has the very bits
// of a sum made from nothing (light_sums.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/gbuffer.h"
#include "renderer/light_maps/patch_lights.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::cpu {

// A VPL made ready for the inner loop.
struct LightRecord {
  enum class Kind : uint8_t { cosine, uniform, directional };
  Kind kind = Kind::cosine;
  const float* map = nullptr;  // null: casts no shadow
  int slot = -1;
  int mapSlot = -1;  // whose map it is
  vec3 position, normal, tangent, bitangent, intensity;
  float coneScale = 0.0f, coneOffset = 1.0f;
  float radius = 0.0f, side = 1.0f;  // directional: R and S
  uint32_t link = 0;                 // renderer/scene/light_linking.h
  bool operator==(const LightRecord&) const = default;
};

LightRecord makeLightRecord(const shared::Vpl& vpl, const float* map);

struct SumConstants {
  float clampDistance2 = 0.0f;  // d0² [m²]
  float bias = 0.0f;
  int resolution = 64;
  float unitsPerIrradiance = 1.0f;  // a power of two [m²/W]
  bool operator==(const SumConstants&) const = default;
};

// The finest unit with which no sum of these lights can overflow, wherever it is taken.
float unitsPerIrradiance(std::span<const LightRecord> lights, float clampDistance2);

// E of each pixel in units, structure of arrays over the whole G-buffer.
struct FixedSums {
  std::vector<int32_t> r, g, b;
};

// Packets, by their first pixels, and which of their lanes are meant. Those of several tiles, so
// that making a light ready is worth it where few of a tile are meant; and of few, so that they
// stay in the first-level cache.
class PacketList {
 public:
  static constexpr size_t kMost = 4 * kPacketsPerTile;
  void clear() { count_ = 0; }
  void add(size_t first, uint8_t lanes) {
    first_[count_] = first;
    lanes_[count_++] = lanes;
  }
  size_t count() const { return count_; }
  size_t first(size_t k) const { return first_[k]; }
  const uint8_t* lanes(size_t k) const { return &lanes_[k]; }

 private:
  size_t first_[kMost];
  uint8_t lanes_[kMost];
  size_t count_ = 0;
};

enum class Sign : uint8_t { add, takeAway };

// Adds what the light gives these pixels by `use` (not skip), or takes it away again. lit: a light
// with a shadow map notes there, by packet of the G-buffer, in which lanes it added or took
// something, and is taken away by that without a look-up; null: it is looked up each time.
void addLight(const GBuffer& gbuffer, const PacketList& packets, LightUse use, Sign sign,
              const LightRecord& light, const SumConstants& constants, uint8_t* lit,
              FixedSums& sums);

}  // namespace lamplighter::cpu
