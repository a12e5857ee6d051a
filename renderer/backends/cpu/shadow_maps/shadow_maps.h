// Shadow maps by ray casting: each texel stores what the ray through its centre hits, so alpha
// masks are correct and no triangle is too small.
#pragma once

#include <span>

#include "renderer/raycast/ray_caster.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::cpu {

// Rays are cast in blocks of texels: a packet of rays is coherent.
inline constexpr int kBlockWidth = 4, kBlockHeight = 2;

// Renders rows [firstRow, lastRow) of the map of `vpl` into `map` (resolution² texels;
// shaders/shared/vpl_shading.h defines their values). `wanted`: by block of these rows, row by row,
// whether to render it; empty: all. Returns the number of rays.
uint64_t traceShadowMap(const RayCaster& rays, const shared::Vpl& vpl, int resolution, int firstRow,
                        int lastRow, std::span<float> map, std::span<const uint8_t> wanted = {});

}  // namespace lamplighter::cpu
