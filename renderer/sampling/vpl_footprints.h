// The footprint of each VPL: the surface area or solid angle that it represents. Specular
// highlights are blurred by it.
#pragma once

#include <span>

#include "renderer/sampling/emitters/lights.h"
#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

// Sets Vpl::footprint of all VPLs, as a function of the VPLs and lights only.
//   On a light's surface: its area divided by the number of its VPLs. Sky: 4π divided by their
//   number. Indirect: a share, by brightness, of the disc around the VPL that contains its
//   kNeighbours nearest ones (the radius of Hašan et al., "Virtual Spherical Lights", 2009):
//     A = π r² I / ΣI.
//   So I / A, the radiance of its highlight, is the average radiance of the surface there.
//   Of more than kMostCompared VPLs, only every n-th is compared.
void findFootprints(const LightSet& lights, std::span<SceneVpl> vpls);

}  // namespace lamplighter
