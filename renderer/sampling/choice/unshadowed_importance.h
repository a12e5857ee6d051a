// Contribution of light samples to the view without shadows: a first, cheap choice among many
// candidates, before rays choose among the remaining ones.
#pragma once

#include <span>
#include <vector>

#include "renderer/sampling/view_points.h"
#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

// Importance of each candidate as importanceOf() defines it, without shadows: √mean over the points
// of (E/ΣE)², with E its irradiance at the point, ΣE that of all candidates, and 1/d² bounded at
// clampDistance [m]. Unit 1, only relative values matter. At most 128 points, world space. No rays;
// the bits do not depend on the number of threads.
std::vector<float> unshadowedImportance(std::span<const SceneVpl> candidates,
                                        std::span<const SeenPoint> points, float clampDistance);

}  // namespace lamplighter
