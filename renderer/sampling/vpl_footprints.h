// How much light each VPL stands for, so that speculars can blur its highlight by that much.
#pragma once

#include <span>

#include "renderer/sampling/emitters/lights.h"
#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

// Sets Vpl::footprint of all.
//   On a light's surface: its area over the number of its VPLs. Of the sky: 4π over their number.
//   Where light has bounced: of the disc around the VPL that holds its kNeighbours nearest ones
//   (the radius of Hašan et al., "Virtual Spherical Lights", 2009), a share by brightness,
//     A = π r² I / ΣI,
//   so that I / A, the radiance that its highlight shows, is what the surface there has on average.
//   Of more than kMostCompared VPLs, every n-th one is compared with.
// A function of the VPLs and lights alone.
void findFootprints(const LightSet& lights, std::span<SceneVpl> vpls);

}  // namespace lamplighter
