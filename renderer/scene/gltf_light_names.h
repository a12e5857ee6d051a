// What reading and saving lights have in common.
#pragma once

#include "renderer/math.h"

namespace lamplighter {

// The member of "extras" that holds what this program notes in a file.
inline constexpr const char* kExtrasName = "lamplighter";

// EXT_lights_area scales a light uniformly, by the largest of its node's world scales; AreaLight
// takes each axis as it is. Lengths in the file times these are AreaLight's: 1 where the scale is
// uniform. A disk takes x.
struct AxisRatios {
  double x, y;
};
AxisRatios areaScale(const vec3& worldScale);

}  // namespace lamplighter
