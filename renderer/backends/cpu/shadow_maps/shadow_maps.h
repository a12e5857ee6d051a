// Shadow maps by ray casting: each texel holds what its centre's ray meets, so alpha masks are
// right and no triangle is too small.
#pragma once

#include <span>

#include "renderer/raycast/ray_caster.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::cpu {

// Rays are cast in blocks of texels: coherent within the packet.
inline constexpr int kBlockWidth = 4, kBlockHeight = 2;

// Renders rows [firstRow, lastRow) of the map of `vpl` into `map` (resolution², see
// shaders/shared/vpl_shading.h for what is stored). Of blocks, row after row of those rows, only
// those that are `wanted`; empty: all. The number of rays that were cast.
uint64_t traceShadowMap(const RayCaster& rays, const shared::Vpl& vpl, int resolution, int firstRow,
                        int lastRow, std::span<float> map, std::span<const uint8_t> wanted = {});

}  // namespace lamplighter::cpu
