// The reaches of shadows of many point lights (shadow_volume.h), eight at a time.
#pragma once

#include <array>
#include <vector>

#include "renderer/visibility/occlusion/shadow_volume.h"

namespace lamplighter {

// Eight of them, a lane each; none where nothing is set.
class ShadowVolumeX8 {
 public:
  static constexpr size_t kLanes = 8;
  using Lanes = std::array<float, kLanes>;

  ShadowVolumeX8();

  // Not that of a parallel light.
  void set(size_t lane, const ShadowVolume::Cone& cone);
  // Bit i is that of lane i. The same as each says itself.
  uint32_t mayFallOn(const vec3& centre, float radius) const;
  // Of those that may fall on the sphere, how far the caster may go or shrink and still reach it
  // [m]; 0 where that is not known.
  void slack(const vec3& centre, float radius, Lanes& out) const;

 private:
  alignas(32) std::array<Lanes, 3> apex_{}, axis_{};
  alignas(32) Lanes nearest_, sine_{}, cosine_{}, before_{}, radius_{};
};

class ShadowVolumes {
 public:
  explicit ShadowVolumes(size_t count)  // all none
      : groups_((count + ShadowVolumeX8::kLanes - 1) / ShadowVolumeX8::kLanes) {}

  // Not of a parallel light.
  void set(size_t i, const ShadowVolume& reach) {
    groups_[i / ShadowVolumeX8::kLanes].set(i % ShadowVolumeX8::kLanes, reach.cone());
  }
  // Of those wanted, whether they may fall on some of the sphere: bit i is that with index
  // 64 * word + i. The same as each says itself.
  uint64_t mayFallOn(size_t word, uint64_t wanted, const vec3& centre, float radius) const;

 private:
  std::vector<ShadowVolumeX8> groups_;
};

}  // namespace lamplighter
