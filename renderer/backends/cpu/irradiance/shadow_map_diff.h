// What of a shadow map changed when it was rendered anew. Where something moves, most maps that see
// it change in a few texels: a light that stays is summed anew only where these are looked up.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/irradiance/light_kernel.h"

namespace lamplighter::cpu {

struct ShadowMapDiff {
  enum class Extent : uint8_t { nothing, part, everything };
  Extent extent = Extent::everything;
  // Of a part: what looks up a texel that changed lies, in light space, within this angle [rad] of
  // this direction (unit); from a parallel light, within this distance of this place in the map's
  // square [-1, 1]².
  vec3 axis{0.0f};
  float reach = 0.0f;
};

// Both of resolution², row after row.
ShadowMapDiff diffShadowMaps(std::span<const float> before, std::span<const float> now,
                             int resolution, bool isParallel);

// Spheres around places, eight side by side.
class PlaceSpheres {
 public:
  void resize(size_t count);
  size_t count() const { return count_; }
  void set(size_t i, const vec3& centre, float radius);

  // By sphere, whether the change of this light's map, nothing or a part, may be looked up in it: 1
  // or 0.
  void findReached(const LightRecord& light, const ShadowMapDiff& change,
                   std::vector<uint8_t>& isReached) const;

 private:
  size_t count_ = 0;
  std::vector<float> x_, y_, z_, radius_;  // world space [m]; in whole eights
};

}  // namespace lamplighter::cpu
