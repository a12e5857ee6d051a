// The scale of the fixed-point irradiance sums (light_kernel.h).
#pragma once

#include <span>

#include "renderer/backends/cpu/irradiance/light_kernel.h"

namespace lamplighter::cpu {

// The largest power of two [m²/W] for which no sum of these lights can overflow at any point.
float unitsPerIrradiance(std::span<const LightRecord> lights, float clampDistance2);

// Whether there are so many lights that what is lost by rounding each to a unit can be seen in dark
// places: more than 1,024.
bool needFineSums(std::span<const LightRecord> lights);

}  // namespace lamplighter::cpu
