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
  // Of those wanted, whether they may fall on some of the sphere: bit i is that with index
  // 64 * word + i. The same as each says itself.
  uint64_t mayFallOn(size_t word, uint64_t wanted, const vec3& centre, float radius) const;

 private:
  using Lanes = std::array<float, kLanes>;
  struct alignas(32) Group {
    std::array<Lanes, 3> apex{}, axis{};
    Lanes nearest, sine{}, cosine{};
  };
  static uint32_t mayFallOn(const Group& group, const vec3& centre, float radius);

  std::vector<Group> groups_;
};

}  // namespace lamplighter
