// A shaft that holds the occlusion pyramids of some lights on one patch: what does not meet it
// meets none of them. It only finds what each pyramid is then tested against, so that states are
// the same bits with and without it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/visibility/occlusion_pyramid.h"

namespace lamplighter {

class LightShaft {
 public:
  // Lights that are not parallel, on a rectangle.
  LightShaft(std::span<const shared::Vpl* const> lights, const PatchRegion& region);

  // Whether the pyramid of the light with this index is in it: not that of a light so nearly in the
  // plane of the patch that rounding widens it, or on the other side of the patch.
  bool holds(size_t light) const { return (held_ >> light & 1) != 0; }
  bool mayMeet(const Bounds& box) const;

 private:
  void add(const vec3& normal, float least);

  static constexpr int kMostPlanes = 16;
  // Inside: dot(normal, x) >= least. Eight at a time are tested: what follows the last are planes
  // that everything is inside of.
  std::array<float, kMostPlanes> x_{}, y_{}, z_{}, least_;
  int count_ = 0;
  float reach_ = 0.0f;  // of what it holds, from the origin along all axes together [m]
  uint64_t held_ = 0;
};

}  // namespace lamplighter
