// Triangles as lights see them, eight at a time. As for the camera (raster.h), a ray d meets a
// triangle a, b, c where d·(b×c), d·(c×a) and d·(a×b) have one sign, in light space; no matter how
// the map folds the directions, nothing is clipped. What is stored, 1/w or a height, is linear in d
// over a plane too.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/shadow_maps/light_space.h"

namespace lamplighter::cpu {

class ShadowTriangles {
 public:
  using Corners = std::array<vec3, 3>;
  static constexpr size_t kLanes = 8;

  // Eight triangles that a light sees.
  struct Batch {
    // Functions of a ray d, f·d: three that are no less than 0 within the triangle, and what is
    // stored.
    static constexpr size_t kPlane = 3, kFunctions = 4;
    // By function: x, y, z, and what f·d may be wrong by.
    alignas(32) float functions[kFunctions][4][kLanes];
    uint32_t lanes = 0;  // a bit for each that may be seen
  };

  // Large ones come first, so that they hide what comes later; a map does not depend on the order.
  void set(std::vector<Corners> triangles);
  size_t batches() const { return count_ / kLanes; }
  // `out`: one for each of batches().
  void see(const LightSpace& light, std::span<Batch> out) const;

 private:
  size_t count_ = 0;  // in whole batches: the last are points, which are never seen
  std::array<std::array<std::vector<float>, 3>, 3> corners_;  // all x, all y, all z
};

}  // namespace lamplighter::cpu
