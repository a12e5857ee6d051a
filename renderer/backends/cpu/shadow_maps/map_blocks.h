// Which blocks of shadow map texels may see a sphere, eight at a time.
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

  // directions: for the kind of the light's map; must outlive this object.
  SphereInMap(const LightSpace& light, const TexelDirections& directions, const Sphere& sphere);
  Where where() const { return where_; }
  // Tests kBlocks blocks from `first` on: one bit for each block that may see the sphere.
  uint32_t blocks(size_t first) const;

 private:
  const TexelDirections& directions_;
  bool isParallel_;
  Where where_ = Where::somewhere;
  vec3 axis_{0.0f};  // unit; for directional light a position in the map's square
  // cosine and sine of the angular radius; directional light: reach_ is a distance in the square
  float cosine_ = 1.0f, reach_ = 0.0f;
};

}  // namespace lamplighter::cpu
