// Light samples of a scene for tests of visibility.
#pragma once

#include <vector>

#include "renderer/sampling/vpl_set.h"
#include "renderer/scene/render_scene.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::test {

// Creates `count` VPLs with three bounces and seed 1; 30% of them are direct.
std::vector<shared::Vpl> lightsOf(const RenderScene& scene, int count);
std::vector<shared::Vpl> lightsOf(const RenderScene& scene, const VplCounts& counts);

}  // namespace lamplighter::test
