// Shared by reading and saving of lights.
#pragma once

#include "renderer/base/math.h"
#include "renderer/scene/scene.h"

namespace lamplighter {

// Shapes that EXT_lights_area does not have; a note on the node stores them.
inline bool isNotedShape(AreaShape shape) {
  return shape == AreaShape::sphere || shape == AreaShape::tube;
}

// Factors from lengths in the file to those of AreaLight. EXT_lights_area scales a light uniformly
// by the largest world scale of its node; AreaLight scales each axis separately. 1 if the scale is
// uniform. A disk uses x.
struct AxisRatios {
  double x, y;
  bool operator==(const AxisRatios&) const = default;
};
AxisRatios areaScale(const vec3& worldScale);
// World scale of each axis of a node with this world matrix.
vec3 axisLengths(const mat4& m);

}  // namespace lamplighter
