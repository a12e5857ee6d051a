// Which blocks of a shadow map's texels may see a sphere, eight at a time.
#pragma once

#include <cstdint>

#include "renderer/backends/cpu/shadow_maps/light_space.h"
#include "renderer/backends/cpu/shadow_maps/texel_directions.h"

namespace lamplighter::cpu {

struct Sphere {  // world space
  vec3 centre;
  float radius;
};

class SphereInMap {
 public:
  enum class Where : uint8_t { nowhere, somewhere, anywhere };
  static constexpr size_t kBlocks = 8;

  // directions: of the light's kind of map, which must outlive it.
  SphereInMap(const LightSpace& light, const TexelDirections& directions, const Sphere& sphere);
  Where where() const { return where_; }
  // Of kBlocks blocks from this one on, those that may see it, if that is somewhere: a bit each.
  uint32_t blocks(size_t first) const;

 private:
  const TexelDirections& directions_;
  bool isParallel_;
  Where where_ = Where::somewhere;
  vec3 axis_{0.0f};                     // unit; of parallel light a place in the map's square
  float cosine_ = 1.0f, reach_ = 0.0f;  // of the angle that it is seen within; its sine, or a
                                        // distance in the square
};

}  // namespace lamplighter::cpu
