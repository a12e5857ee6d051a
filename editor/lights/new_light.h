// Lights as they are when they are put into a scene: of a size and strength that suit the place.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace lamplighter {

// rectangle, disk, sphere, tube, spot, point, sun
const std::vector<std::string>& newLightKinds();

// A light that shows a white surface at `distance` [m] before it as 0.4 · 2^−EV: mid-grey to white
// at that exposure. Its size follows the distance, too. Throws InputError for an unknown kind.
Node newLight(const std::string& kind, float distance, float exposureEv);

}  // namespace lamplighter
