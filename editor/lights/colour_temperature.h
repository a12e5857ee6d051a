// Colours of black bodies by temperature, as used for lamps: 2700 K is a warm lamp, 6500 K is
// daylight.
#pragma once

#include <optional>

#include "renderer/base/math.h"

namespace lamplighter {

inline constexpr float kLeastKelvin = 1000.0f, kMostKelvin = 15000.0f;

// Linear Rec. 709 with luminance 1. Colours outside the gamut, below about 1900 K, have no blue.
// The chromaticity is Krystek's fit (M. Krystek, "An algorithm to calculate correlated colour
// temperature", Color Research & Application 10(1), 1985), accurate to 8e-5 in CIE 1960 u and v
// from 1000 to 15000 K.
vec3 planckianColour(float kelvin);

// The temperature with the nearest colour in CIE 1960 u and v. None for black, and for colours
// whose distance to all of them is over 0.0054, the limit up to which CIE 13.3 accepts a lamp as
// white.
std::optional<float> temperatureOf(const vec3& colour);

// Changes the temperature of a colour and keeps its luminance.
vec3 withTemperature(const vec3& colour, float kelvin);

}  // namespace lamplighter
