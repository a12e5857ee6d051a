// Chooses how many packets are summed in one frame, by counted work.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "renderer/backends/cpu/irradiance/irradiance_accumulator.h"

namespace lamplighter::cpu {

class PacketLimit {
 public:
  // For an update of `sums` to these lights: limits lights × pixels, approximately.
  PacketLimit(const GBuffer& gbuffer, const IrradianceAccumulator& sums,
              std::span<const LightRecord> lights, uint64_t mostLightPixels);

  void lowerTo(uint64_t mostLightPixels) { left_ = std::min(left_, mostLightPixels); }

  // Those of these packets of a tile (one bit each) that are already summed and remain so; none if
  // the limit is reached.
  uint32_t goOn(size_t tile, uint32_t packets);
  // The packets to sum from scratch. The first call with such packets gets them in any case, so
  // that each frame makes progress.
  uint32_t begin(size_t tile, uint32_t packets);
  bool isReached() const { return left_ == 0; }

  // Lights × pixels of a sum from scratch.
  uint64_t costOf(uint32_t packets) const { return cost(packets, all_); }

 private:
  static uint64_t cost(uint32_t packets, uint64_t lights) {
    return static_cast<uint64_t>(std::popcount(packets)) * kLanes * lights;
  }

  const GBuffer& gbuffer_;
  const IrradianceAccumulator& sums_;
  uint64_t all_ = 0, changes_ = 0;  // lights of a new packet, and of a continued one
  uint64_t left_ = 0;
  bool hasBegun_ = false;
};

}  // namespace lamplighter::cpu
