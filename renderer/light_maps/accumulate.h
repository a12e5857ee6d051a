// Adds lights to the sums of one light map tile, eight texels at a time.
#pragma once

#include <span>

#include "renderer/base/math.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// The plane of a tile and the positions of its texels on that plane.
struct TexelPlaces {
  vec3 origin, tangent, bitangent, normal;  // of the plane, as in Chart
  vec2 min, max;                            // bounds of all texels
  std::span<const float> u, w;  // along tangent and bitangent [m]; the size is a multiple of eight
};

// A light to add to the texels (sign 1) or to subtract from them (sign −1).
struct SummedLight {
  SummedLight(const shared::Vpl& vpl, float sign);
  float kind;               // Vpl::position.w
  vec3 position, axis;      // axis: Vpl::normal
  vec3 tangent, bitangent;  // axes of the square of a directional light
  vec3 intensity;           // multiplied by the sign
  float coneScale, side;    // Vpl::normal.w and Vpl::tangent.w
};

// Each contribution is rounded to a multiple of this [W/m²]. A double holds sums of such multiples
// exactly up to 2⁵³ × this value.
inline constexpr double kIrradianceUnit = 1.0 / 67108864.0;  // 2⁻²⁶

// Adds the unshadowed irradiance of the lights, each rounded to a multiple of kIrradianceUnit; a
// contribution must be below 2²⁴ W/m². r, g, b: one sum per texel. Uses the formulas of vplGeometry
// in vpl_shading.h. The bits of the sums do not depend on the order of the lights.
void accumulate(std::span<const SummedLight* const> lights, const TexelPlaces& places,
                float clampDistance, double* r, double* g, double* b);

// Converts the sums to the values that are read: rgb is E [W/m²]. The number of texels is a
// multiple of eight.
void readSums(const double* r, const double* g, const double* b, std::span<vec4> out);

}  // namespace lamplighter
