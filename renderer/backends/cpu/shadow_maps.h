// Shadow maps by ray casting: each texel holds what its centre's ray meets, so alpha masks are
// right and no triangle is too small.
#pragma once

#include <span>

#include "renderer/raycast/ray_caster.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::cpu {

// Renders rows [firstRow, lastRow) of the map of `vpl` into `map` (resolution², see
// shaders/shared/vpl_shading.h for what is stored).
void traceShadowMap(const RayCaster& rays, const shared::Vpl& vpl, int resolution, int firstRow,
                    int lastRow, std::span<float> map);

}  // namespace lamplighter::cpu
