// Lights into the sums of one light-map tile, eight texels at a time.
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

// A light as it is added to texels (sign 1) or taken away from them (−1).
struct TexelLight {
  TexelLight(const shared::Vpl& vpl, float sign);
  float kind;               // Vpl::position.w
  vec3 position, axis;      // axis: Vpl::normal
  vec3 tangent, bitangent;  // of a parallel light's square
  vec3 intensity;           // times the sign
  vec3 units;               // the same, in units
  float coneScale, side;    // Vpl::normal.w and Vpl::tangent.w
};

// What a contribution is rounded to [W/m²]. Sums of its multiples are exact in a double up to
// 2⁵³ times it.
inline constexpr double kIrradianceUnit = 1.0 / 67108864.0;  // 2⁻²⁶

// Adds the irradiance of the lights, without shadow, each rounded to a multiple of kIrradianceUnit;
// below 2²⁴ W/m². r, g, b: a sum for each texel. Follows vplGeometry of vpl_shading.h. Puts the
// lights in another order; no order changes a bit of the sums.
void accumulate(std::span<const TexelLight*> lights, const TexelPlaces& places, float clampDistance,
                double* r, double* g, double* b);

}  // namespace lamplighter
