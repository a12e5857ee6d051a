// What every technique of many_lights should show: the same VPLs with a ray for each shadow.
#pragma once

#include "renderer/image/image.h"
#include "renderer/parameters.h"
#include "renderer/scene/scene.h"
#include "renderer/view.h"

namespace lamplighter::test {

// One sample at each pixel's middle, as with `antialias` 1.
Image withTracedShadows(const Scene& scene, const View& view, const Settings& settings);

}  // namespace lamplighter::test
