// How often stored depths and traced rays disagree about visibility.
#pragma once

#include "renderer/surface_depths/surface_depths.h"
#include "renderer/surface_depths/texel_tree.h"

namespace lamplighter {

// Share of the visibility tests of a texel's links in which depths and rays disagree, from 0 to 1.
// Uses up to `most` tests, evenly spread over all of them, with one ray each. `linkError`: as in
// TexelLinks::restart(). The depths must be complete.
float queryErrorOf(uint32_t texel, const RenderScene& scene, const RayCaster& rays,
                   const TexelSet& texels, const TexelTree& tree, const SurfaceDepths& depths,
                   float linkError, size_t most);

}  // namespace lamplighter
