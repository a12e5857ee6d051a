// Samples of a pixel beside its middle are there to smooth edges: where the picture goes on evenly
// over one surface, all take the light of the middle. They lie about it, so that what that is off
// by cancels in their mean.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/gbuffer/gbuffer.h"
#include "renderer/backends/cpu/picture_light.h"

namespace lamplighter::cpu {

class AdaptiveAntialiasing {
 public:
  // The picture of pixels' middles, and its light.
  void take(const GBuffer& middle, const PictureLight& light);
  void forget() { isTaken_ = false; }
  bool isTaken() const { return isTaken_; }

  // Of a picture with pixels moved by less than one: by tile, packets that show another surface
  // than in the middle, or where light there was uneven.
  std::span<const uint32_t> findOwn(const GBuffer& middle, const GBuffer& moved);

 private:
  bool isTaken_ = false;
  std::vector<uint32_t> even_, own_;  // by tile, a bit a packet
};

}  // namespace lamplighter::cpu
