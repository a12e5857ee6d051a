// Mapping of the directions around a point to pixels: a cube map, or an octahedral map of the
// sphere.
#pragma once

#include <cstdint>

#include "renderer/base/math.h"

namespace lamplighter {

enum class DepthMapKind : uint8_t { cube, octahedral };

struct DepthMapLayout {
  DepthMapKind kind = DepthMapKind::cube;
  int resolution = 32;  // along a side of the map, or of a face of the cube
  bool operator==(const DepthMapLayout&) const = default;

  uint32_t pixels() const {
    const auto side = static_cast<uint32_t>(resolution);
    return (kind == DepthMapKind::cube ? 6 : 1) * side * side;
  }
  // The pixel of a direction in world space, of any length except 0.
  uint32_t pixelOf(const vec3& direction) const;
  // The direction of the centre of a pixel; unit length.
  vec3 directionOf(uint32_t pixel) const { return glm::normalize(pointOf(pixel)); }
  // Approximate solid angle of a pixel [sr]; the sum over all pixels is 4π within 0.2%.
  float solidAngleOf(uint32_t pixel) const;
  // Approximate maximum angle between the centre and a corner of a pixel [rad].
  float halfWidth() const;

 private:
  vec3 pointOf(uint32_t pixel) const;  // on the cube or the octahedron
};

}  // namespace lamplighter
