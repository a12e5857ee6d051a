// Which lights make hard shadows that the low-resolution pass must not interpolate
// (shaders/shared/low_resolution.h).
#pragma once

#include <span>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter {

struct LightStrength {
  // As in Vpl.position.w.
  enum class Kind : uint8_t { cosine, uniform, directional } kind = Kind::cosine;
  vec3 direction{0.0f};    // of parallel light
  float brightest = 0.0f;  // channel of its intensity
  int slot = -1;           // < 0: casts no shadow
};

// Slots of the parallel or punctual ones with more than kHardShare of the light of all parallel or
// all other lights.
std::vector<int> hardLights(std::span<const LightStrength> lights);

}  // namespace lamplighter
