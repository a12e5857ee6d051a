// Real spherical harmonics of order 5: bands 0 to 4, 25 of them, as paper 1 (4.4.1) uses for light
// about an object and for what its vertices make of it.
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

// Y of a unit vector: also the coefficients of a unit of light from that direction alone, which for
// the sum of Y times coefficients is the delta function's (directional source; paper 1, 4.4.1).
ShVector shBasis(const vec3& direction);

// The factors of Ramamoorthi and Hanrahan's equation 8, π times those of a normalised cosine:
// convolution with max(0, cos θ) multiplies band l by it. π, 2π/3, π/4, 0, −π/24.
inline constexpr std::array<float, kShBands> kCosineFactors{3.14159265f, 2.09439510f, 0.78539816f,
                                                            0.0f, -0.13089969f};

// Transfer of an unshadowed plane with this unit normal: its dot product with the coefficients of
// incident radiance is irradiance.
ShVector cosineTransfer(const vec3& normal);

float shDot(const ShVector& a, const ShVector& b);

}  // namespace lamplighter
