// Finds the lights that need shadow maps for a view. For all other lights the visibility database
// alone decides every visible pixel (paper 1, 6.2).
#pragma once

#include <vector>

#include "renderer/scene/camera.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

// By slot, 1: the light is partial on some patch that may be visible. Not visible are patches
// outside the frustum, back faces of objects whose backs are not drawn, and patches that one
// polygon hides completely from the eye.
std::vector<uint8_t> shadowMapDemand(const VisibilityDatabase& visibility, const RenderScene& scene,
                                     const View& view);

}  // namespace lamplighter
