// What reading and saving lights have in common.
#pragma once

#include "renderer/math.h"

namespace lamplighter {

// EXT_lights_area scales a light uniformly, by the largest of its node's world scales; AreaLight
// takes each axis as it is. Lengths in the file times these are AreaLight's: 1 where the scale is
// uniform. A disk takes x.
struct AxisRatios {
  double x, y;
  bool operator==(const AxisRatios&) const = default;
};
AxisRatios areaScale(const vec3& worldScale);
// The world scale by axis of a node with this world matrix.
vec3 axisLengths(const mat4& m);

}  // namespace lamplighter
