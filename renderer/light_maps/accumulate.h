// One light into the sums of one light-map tile, eight texels at a time.
#pragma once

#include <span>

#include "renderer/math.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// Places of a tile's texels in the world, and their plane.
struct TexelPlaces {
  std::span<const float> x, y, z;  // [m]; the number of them a multiple of eight
  vec3 normal;                     // unit
};

// What a contribution is rounded to [W/m²]. Sums of its multiples are exact in a double up to
// 2⁵³ times it.
inline constexpr double kIrradianceUnit = 1.0 / 67108864.0;  // 2⁻²⁶

// Adds (sign 1) or takes away (−1) the irradiance of the VPL, without shadow, rounded to multiples
// of kIrradianceUnit. r, g, b: `count` sums each. Follows vplGeometry of vpl_shading.h.
void accumulate(const shared::Vpl& vpl, const TexelPlaces& places, float clampDistance, double sign,
                size_t count, double* r, double* g, double* b);

}  // namespace lamplighter
