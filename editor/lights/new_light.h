// Creates lights whose size and strength fit the place where they are added.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace lamplighter {

// rectangle, disk, sphere, tube, spot, point, sun
const std::vector<std::string>& newLightKinds();

// The strength is chosen so that a white surface at `distance` [m] from the light has the radiance
// 0.4 · 2^−EV, which that exposure shows between mid-grey and white. The size also follows the
// distance; its bounds are in units of `unit` metres, which suits the level. Throws InputError for
// an unknown kind.
Node newLight(const std::string& kind, float distance, float exposureEv, float unit);

}  // namespace lamplighter
