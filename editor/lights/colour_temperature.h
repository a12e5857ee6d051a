// Colours of black bodies, as light is named in shops: 2700 K is a warm lamp, 6500 K daylight.
#pragma once

#include <optional>

#include "renderer/base/math.h"

namespace lamplighter {

inline constexpr float kLeastKelvin = 1000.0f, kMostKelvin = 15000.0f;

// Linear Rec. 709 of luminance 1. What lies outside of its gamut, below about 1900 K, has no blue.
// The chromaticity is Krystek's fit (M. Krystek, "An algorithm to calculate correlated colour
// temperature", Color Research & Application 10(1), 1985), good to 8e-5 in CIE 1960 u and v from
// 1000 to 15000 K.
vec3 planckianColour(float kelvin);

// The temperature whose colour is nearest in CIE 1960 u and v; none for black and for colours that
// are farther than 0.0054 from all of them, up to which CIE 13.3 takes a lamp for white.
std::optional<float> temperatureOf(const vec3& colour);

// The colour with another temperature and the same luminance.
vec3 withTemperature(const vec3& colour, float kelvin);

}  // namespace lamplighter
