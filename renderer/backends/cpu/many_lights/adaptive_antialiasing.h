// The jittered pictures smooth edges. Where the light varies evenly over one surface, a jittered
// pixel takes the light of the middle picture instead of its own. The jitters are symmetric about
// the pixel's middle, so this error cancels in the mean.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/gbuffer/gbuffer.h"
#include "renderer/backends/cpu/many_lights/picture_light.h"

namespace lamplighter::cpu {

class AdaptiveAntialiasing {
 public:
  // Stores the picture with unjittered pixels and its light.
  void take(const GBuffer& middle, const PictureLight& light);
  void forget() { isTaken_ = false; }
  bool isTaken() const { return isTaken_; }

  // For a picture jittered by less than one pixel: by tile, the packets that need their own light,
  // because they show another surface than the middle picture or because the light there was
  // uneven.
  std::span<const uint32_t> findOwn(const GBuffer& middle, const GBuffer& moved);

 private:
  bool isTaken_ = false;
  std::vector<uint32_t> even_, own_;  // by tile, one bit per packet
};

}  // namespace lamplighter::cpu
