// Triangles as seen by lights, eight at a time. As for the camera (raster.h), a ray d in light
// space meets a triangle a, b, c where d·(b×c), d·(c×a) and d·(a×b) have one sign. This holds for
// any mapping of directions to texels, and nothing is clipped. The stored value, 1/w or a height,
// is also linear in d over a plane.
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

  // Eight triangles in the space of a light.
  struct Batch {
    // Functions f·d of a ray d: three edge functions, ≥ 0 inside the triangle, and the stored
    // value.
    static constexpr size_t kPlane = 3, kFunctions = 4;
    // By function: x, y, z, and the largest error of f·d.
    alignas(32) float functions[kFunctions][4][kLanes];
    uint32_t lanes = 0;  // one bit for each triangle that may be visible
  };

  // Sorts large triangles first, because they hide later ones. The order does not change a map.
  void set(std::vector<Corners> triangles);
  size_t batches() const { return count_ / kLanes; }
  // `out`: one entry for each of batches().
  void see(const LightSpace& light, std::span<Batch> out) const;

 private:
  size_t count_ = 0;  // padded to whole batches with degenerate triangles, which are never seen
  std::array<std::array<std::vector<float>, 3>, 3> corners_;  // all x, all y, all z
};

}  // namespace lamplighter::cpu
