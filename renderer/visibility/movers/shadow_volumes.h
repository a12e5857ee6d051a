// Shadow volumes of many point lights (shadow_volume.h), eight at a time.
#pragma once

#include <array>
#include <vector>

#include "renderer/visibility/occlusion/shadow_volume.h"

namespace lamplighter {

// Eight shadow volumes, one per lane; a lane that is not set is empty.
class ShadowVolumeX8 {
 public:
  static constexpr size_t kLanes = 8;
  using Lanes = std::array<float, kLanes>;

  ShadowVolumeX8();

  // Not for parallel lights.
  void set(size_t lane, const ShadowVolume::Cone& cone);
  // Bit i: lane i. Bit-equal to ShadowVolume::mayFallOn().
  uint32_t mayFallOn(const vec3& centre, float radius) const;
  // For lanes whose shadow may fall on the sphere: how far the caster may move or shrink so that
  // the shadow still reaches the sphere [m]; 0 if unknown.
  void slack(const vec3& centre, float radius, Lanes& out) const;

 private:
  alignas(32) std::array<Lanes, 3> apex_{}, axis_{};
  alignas(32) Lanes nearest_, sine_{}, cosine_{}, before_{}, radius_{};
};

class ShadowVolumes {
 public:
  explicit ShadowVolumes(size_t count)  // all empty
      : groups_((count + ShadowVolumeX8::kLanes - 1) / ShadowVolumeX8::kLanes) {}

  // Not for parallel lights.
  void set(size_t i, const ShadowVolume& volume) {
    groups_[i / ShadowVolumeX8::kLanes].set(i % ShadowVolumeX8::kLanes, volume.cone());
  }
  // For the wanted shadow volumes: whether the shadow may fall on part of the sphere. Bit i is the
  // volume with index 64 * word + i. Bit-equal to ShadowVolume::mayFallOn().
  uint64_t mayFallOn(size_t word, uint64_t wanted, const vec3& centre, float radius) const;

 private:
  std::vector<ShadowVolumeX8> groups_;
};

}  // namespace lamplighter
