// A path whose light has moved: kept or drawn anew so that its first vertex is distributed as light
// leaves the light where it is now.
#pragma once

#include "renderer/sampling/path_tracing.h"

namespace lamplighter {

// `path`, whose first step is distributed as light leaves `before`, becomes one whose first step is
// distributed as it leaves `now`, by maximal coupling: with p and q the densities of the first
// vertex [1/m², shadows included] it stays with probability min(1, q/p), and is drawn from max(0, q
// − p) otherwise, so that it stays as often as any way of choosing allows and carries the same flux
// as ever. Neither of them parallel. `edit`: which random numbers. Returns the rays traced.
//
// A light's own body does not count as standing in the way of `before`, which is exact for convex
// ones; and a thousand tries are the most, after which the last is taken.
int followStart(const PathWalker& walker, const PathWalker::Source& source, const Departure& before,
                const Departure& now, uint32_t edit, LightPath& path);

// Whether both meet the same, to within a distance [m].
bool isNearly(const LightPath& a, const LightPath& b, float distance);

}  // namespace lamplighter
