// The expected picture of every technique of many_lights: the same VPLs with a shadow ray for each.
#pragma once

#include <span>
#include <vector>

#include "renderer/base/parameters.h"
#include "renderer/image/image.h"
#include "renderer/methods/inspection.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter::test {

// The VPLs of the inspection.
std::vector<shared::Vpl> shownLights(const Inspection& inspection);

// One sample at each pixel centre, as with `antialias` 1, without `bias_compensation`, and without
// light linking. `vpls`: the VPLs of the picture to compare with, which depend on its view.
// `known`, if given: rays are traced only where it gives no answer, just as maps are looked up. If
// it is correct, it does not change the result.
Image withTracedShadows(const RenderScene& scene, const RayCaster& rays,
                        std::span<const shared::Vpl> vpls, const View& view,
                        const Settings& settings, const PatchView* known = nullptr);

}  // namespace lamplighter::test
