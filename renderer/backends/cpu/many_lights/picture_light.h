// The source of the light of the packets of a picture.
#pragma once

#include <cstdint>
#include <span>

#include "renderer/backends/cpu/irradiance/irradiance_accumulator.h"
#include "renderer/backends/cpu/many_lights/low_resolution.h"

namespace lamplighter::cpu {

struct PictureLight {
  const IrradianceAccumulator& sums;
  const LowResolution* low = nullptr;  // interpolates between samples; null: all pixels are summed
  // Another picture of the same view: all packets except `own` (by tile, one bit each) take its
  // light. Null: none.
  const PictureLight* other = nullptr;
  std::span<const uint32_t> own;

  // As PacketLight.
  PacketIrradianceView at(int tile, int packet, PacketIrradiance& room) const;
  // Whether the packet is interpolated.
  bool isBetween(int tile, int packet) const {
    return low != nullptr && (low->summed()[static_cast<size_t>(tile)] >> packet & 1) == 0;
  }
};

}  // namespace lamplighter::cpu
