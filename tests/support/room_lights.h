// Light samples of a scene for tests of what lies between them and its surfaces.
#pragma once

#include <vector>

#include "renderer/scene/render_scene.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::test {

// So many VPLs in all, three tenths of them direct, of three bounces, with seed 1.
std::vector<shared::Vpl> lightsOf(const RenderScene& scene, int count);

}  // namespace lamplighter::test
