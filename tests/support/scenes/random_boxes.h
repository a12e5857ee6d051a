// A scene without symmetry, for comparing backends.
#pragma once

#include "renderer/scene/scene.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::test {

// A room of 8×4×8 m around the origin, open at the top, with rotated boxes in several colours.
Scene randomBoxes(int count, uint32_t seed);
// VPLs with random positions and axes inside that room.
std::vector<shared::Vpl> randomVpls(int count, uint32_t seed);

}  // namespace lamplighter::test
