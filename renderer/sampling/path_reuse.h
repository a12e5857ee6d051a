// Keeps or redraws a path of a moved light, so that its first vertex is distributed as light leaves
// the light at its new position.
#pragma once

#include "renderer/sampling/path_tracing.h"

namespace lamplighter {

// Changes `path`, whose first step is distributed as light leaves `before`, so that it is
// distributed as light leaves `now`, by maximal coupling. With p and q the old and new densities of
// the first vertex [1/m², including shadows], the path stays with probability min(1, q/p);
// otherwise it is drawn from max(0, q − p). So it stays as often as any method allows, and its flux
// is unchanged. Neither departure may be parallel. `edit` selects the random numbers. Returns the
// number of rays traced.
//
// The light's own body is assumed not to block `before`, which is exact for convex bodies. At most
// 1000 candidates are tried; then the last one is used.
int followStart(const PathWalker& walker, const PathWalker::Source& source, const Departure& before,
                const Departure& now, uint32_t edit, LightPath& path);

// Whether the vertices of both paths agree within a distance [m].
bool isNearly(const LightPath& a, const LightPath& b, float distance);

}  // namespace lamplighter
