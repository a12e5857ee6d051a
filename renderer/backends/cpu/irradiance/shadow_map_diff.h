// The part of a shadow map that changed when it was rendered again. When something moves, most maps
// that see it change in few texels. A light that stays is summed again only where these texels are
// read.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/irradiance/light_kernel.h"

namespace lamplighter::cpu {

struct ShadowMapDiff {
  enum class Extent : uint8_t { nothing, part, everything };
  Extent extent = Extent::everything;
  // For a partial change. Points that read a changed texel lie, in light space, within this angle
  // [rad] of this unit direction. For a directional light: within this distance of this position in
  // the square [-1, 1]² of the map.
  vec3 axis{0.0f};
  float reach = 0.0f;
};

// Both have resolution² texels, row by row.
ShadowMapDiff diffShadowMaps(std::span<const float> before, std::span<const float> now,
                             int resolution, bool isParallel);

// Bounding spheres of places, processed eight at a time.
class PlaceSpheres {
 public:
  void resize(size_t count);
  size_t count() const { return count_; }
  void set(size_t i, const vec3& centre, float radius);

  // By sphere, 1 or 0: whether points in it may read a texel that changed. The change must be empty
  // or partial.
  void findReached(const LightRecord& light, const ShadowMapDiff& change,
                   std::vector<uint8_t>& isReached) const;

 private:
  size_t count_ = 0;
  std::vector<float> x_, y_, z_, radius_;  // world space [m]; padded to a multiple of eight
};

}  // namespace lamplighter::cpu
