// Real spherical harmonics of order 5: bands 0 to 4, 25 functions, as paper 1 (4.4.1) uses them for
// the light around an object and for the transfer of its vertices.
//
// Orthonormal over the sphere, without the Condon-Shortley phase: Y₀₀ = 1/√4π, Y₁,₋₁ ∝ y, Y₁₀ ∝ z,
// Y₁₁ ∝ x (Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps",
// 2001, equation 2). Order m from −l to l within band l.
#pragma once

#include <array>

#include "renderer/base/math.h"

namespace lamplighter {

inline constexpr int kShBands = 5;
inline constexpr int kShCoefficients = kShBands * kShBands;

// By index l(l + 1) + m.
using ShVector = std::array<float, kShCoefficients>;

constexpr int shIndex(int band, int order) { return band * (band + 1) + order; }

// Y of a unit vector. These are also the coefficients of unit light from only that direction (delta
// function, directional source; paper 1, 4.4.1).
ShVector shBasis(const vec3& direction);

// The factors of equation 8 of Ramamoorthi and Hanrahan, π times those of a normalised cosine:
// convolution with max(0, cos θ) multiplies band l by them. π, 2π/3, π/4, 0, −π/24.
inline constexpr std::array<float, kShBands> kCosineFactors{3.14159265f, 2.09439510f, 0.78539816f,
                                                            0.0f, -0.13089969f};

// Transfer of an unshadowed plane with this unit normal: its dot product with the coefficients of
// incident radiance is the irradiance.
ShVector cosineTransfer(const vec3& normal);

float shDot(const ShVector& a, const ShVector& b);

}  // namespace lamplighter
