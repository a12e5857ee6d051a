// What reading and saving lights have in common.
#pragma once

#include "renderer/base/math.h"
#include "renderer/scene/scene.h"

namespace lamplighter {

// Shapes that EXT_lights_area does not have: a note on the node says what they are.
inline bool isNotedShape(AreaShape shape) {
  return shape == AreaShape::sphere || shape == AreaShape::tube;
}

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
