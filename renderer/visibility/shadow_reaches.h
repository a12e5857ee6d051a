// The reaches of shadows of many point lights (shadow_reach.h), eight at a time.
#pragma once

#include <array>
#include <vector>

#include "renderer/visibility/shadow_reach.h"

namespace lamplighter {

class ShadowReaches {
 public:
  static constexpr size_t kLanes = 8;

  explicit ShadowReaches(size_t count);  // all none

  // Not of a parallel light.
  void set(size_t i, const ShadowReach& reach);
  // Bit i: whether that with index kLanes * group + i may fall on some of the sphere; the same as
  // each says itself.
  uint32_t mayFallOn(size_t group, const vec3& centre, float radius) const;

 private:
  using Lanes = std::array<float, kLanes>;
  struct alignas(32) Group {
    std::array<Lanes, 3> apex{}, axis{};
    Lanes nearest, sine{}, cosine{};
  };
  std::vector<Group> groups_;
};

}  // namespace lamplighter
