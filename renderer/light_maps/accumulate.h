// Lights into the sums of one light-map tile, eight texels at a time.
#pragma once

#include <span>

#include "renderer/base/math.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// A tile's plane, and where its texels are on it.
struct TexelPlaces {
  vec3 origin, tangent, bitangent, normal;  // of the plane, as of a Chart
  vec2 min, max;                            // all texels are between
  std::span<const float> u, w;  // along tangent and bitangent [m]; a multiple of eight of them
};

// A light as it is added to texels (sign 1) or taken away from them (−1).
struct TexelLight {
  TexelLight(const shared::Vpl& vpl, float sign);
  float kind;               // Vpl::position.w
  vec3 position, axis;      // axis: Vpl::normal
  vec3 tangent, bitangent;  // of a parallel light's square
  vec3 intensity;           // times the sign
  float coneScale, side;    // Vpl::normal.w and Vpl::tangent.w
};

// What a contribution is rounded to [W/m²]. Sums of its multiples are exact in a double up to
// 2⁵³ times it.
inline constexpr double kIrradianceUnit = 1.0 / 67108864.0;  // 2⁻²⁶

// Adds the irradiance of the lights, without shadow, each rounded to a multiple of kIrradianceUnit;
// below 2²⁴ W/m². r, g, b: a sum for each texel. Follows vplGeometry of vpl_shading.h. No
// order of the lights changes a bit of the sums.
void accumulate(std::span<const TexelLight* const> lights, const TexelPlaces& places,
                float clampDistance, double* r, double* g, double* b);

// What is summed, as it is read: rgb, E [W/m²]. A multiple of eight texels.
void readSums(const double* r, const double* g, const double* b, std::span<vec4> out);

}  // namespace lamplighter
