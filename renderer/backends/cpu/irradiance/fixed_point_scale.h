// The unit that sums of lights are whole numbers of (light_kernel.h).
#pragma once

#include <span>

#include "renderer/backends/cpu/irradiance/light_kernel.h"

namespace lamplighter::cpu {

// The finest with which no sum of these lights can overflow, wherever it is taken: a power of two
// [m²/W].
float unitsPerIrradiance(std::span<const LightRecord> lights, float clampDistance2);

}  // namespace lamplighter::cpu
