// A scene without any symmetry, for comparing backends.
#pragma once

#include "renderer/scene/scene.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::test {

// A room of 8×4×8 m about the origin, open at the top, with turned boxes of several colours in it.
Scene randomBoxes(int count, uint32_t seed);
// VPLs in that room's air with random axes.
std::vector<shared::Vpl> randomVpls(int count, uint32_t seed);

}  // namespace lamplighter::test
