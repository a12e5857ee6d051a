// How the packets of a picture come by their light.
#pragma once

#include <cstdint>
#include <span>

#include "renderer/backends/cpu/irradiance/irradiance_accumulator.h"
#include "renderer/backends/cpu/low_resolution.h"

namespace lamplighter::cpu {

struct PictureLight {
  using Irradiance = LowResolution::Irradiance;
  const IrradianceAccumulator& sums;
  const LowResolution* low = nullptr;  // what is between the samples; null: all are summed
  // Another picture of the view, of which all but `own` packets take theirs (by tile, a bit each);
  // null: there is none.
  const PictureLight* other = nullptr;
  std::span<const uint32_t> own;

  // E [W/m²] at the eight pixels of a packet: where it is kept, or what `room` was filled with.
  struct Packet {
    const float *r, *g, *b;
  };
  Packet at(int tile, int packet, Irradiance& room) const;
  // Whether it is interpolated.
  bool isBetween(int tile, int packet) const {
    return low != nullptr && (low->edges()[static_cast<size_t>(tile)] >> packet & 1) == 0;
  }
};

}  // namespace lamplighter::cpu
