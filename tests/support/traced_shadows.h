// What every technique of many_lights should show: the same VPLs with a ray for each shadow.
#pragma once

#include <span>
#include <vector>

#include "renderer/base/parameters.h"
#include "renderer/image/image.h"
#include "renderer/methods/inspection.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter::test {

// Those that are shown.
std::vector<shared::Vpl> shownLights(const Inspection& inspection);

// One sample at each pixel's middle, as with `antialias` 1, without `corner_light`. No light leaves
// anything out. `vpls`: as the picture that it is compared with has them, which were chosen for its
// view. `visibility`, if any: rays are traced only where it does not know, as maps are looked up;
// it is right where that changes nothing.
Image withTracedShadows(const RenderScene& scene, const RayCaster& rays,
                        std::span<const shared::Vpl> vpls, const View& view,
                        const Settings& settings, const VisibilityDatabase* visibility = nullptr);

}  // namespace lamplighter::test
