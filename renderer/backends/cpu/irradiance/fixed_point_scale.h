// The scale of the fixed-point irradiance sums (light_kernel.h).
#pragma once

#include <span>

#include "renderer/backends/cpu/irradiance/light_kernel.h"

namespace lamplighter::cpu {

// The largest power of two [m²/W] for which no sum of these lights can overflow at any point.
float unitsPerIrradiance(std::span<const LightRecord> lights, float clampDistance2);

// Whether the error of rounding each light to a unit is visible in dark places: there are more than
// 1,024 lights, or more than 32 that are dim relative to the total. A dim light gives less than a
// unit at a distance of 8 m.
bool needFineSums(std::span<const LightRecord> lights, float unitsPerIrradiance);

}  // namespace lamplighter::cpu
