// Formats numbers with units as text.
#pragma once

#include <string>

#include "renderer/base/math.h"

namespace lamplighter {

// Three significant digits; estimates from samples are not more precise: "0.0123", "12.3", "12300".
std::string threeDigits(float value);
std::string luxText(float irradiance);       // "123 lx"
std::string nitsText(float luminance);       // "45.6 nt"
std::string metresText(float metres);        // "2.350 m", "0.0123 m"
std::string offsetText(const vec3& metres);  // "dx +1.000  dy -0.500  dz +0.000 m"
std::string percentText(float share);        // "12%", "0.4%", "<0.1%"

}  // namespace lamplighter
