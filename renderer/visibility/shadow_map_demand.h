// Which lights a view wants shadow maps of: of all others the visibility database knows wherever
// the view may look (paper 1, 6.2).
#pragma once

#include <vector>

#include "renderer/scene/camera.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

// By slot, 1: the light is partial on some patch that may be seen. Patches outside of the view, and
// those whose backs are turned to the eye where backs are not drawn, are not, nor are those that
// one polygon hides from it.
std::vector<uint8_t> shadowMapDemand(const VisibilityDatabase& visibility, const RenderScene& scene,
                                     const View& view);

}  // namespace lamplighter
