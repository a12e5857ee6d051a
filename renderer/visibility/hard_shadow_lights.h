// Finds the lights with hard shadows: the low-resolution pass must not interpolate across their
// shadow borders (shaders/shared/low_resolution.h).
#pragma once

#include <span>
#include <vector>

#include "renderer/base/math.h"
#include "renderer/scene/vpl.h"

namespace lamplighter {

struct LightStrength {
  // The kinds of Vpl.position.w.
  enum class Kind : uint8_t { cosine, uniform, directional } kind = Kind::cosine;
  vec3 direction{0.0f};    // for parallel light
  float brightest = 0.0f;  // largest channel of the intensity
  int slot = -1;           // < 0: casts no shadow
};
inline LightStrength strengthOf(const shared::Vpl& vpl, int slot) {
  return {static_cast<LightStrength::Kind>(static_cast<int>(vpl.position.w)), vec3(vpl.normal),
          brightness(vpl), slot};
}

// Returns the slots of hard-shadow lights. A parallel light is one if it has more than kHardShare
// of all parallel light; a punctual one if it has more than kHardShare of all other light.
std::vector<int> hardLights(std::span<const LightStrength> lights);

}  // namespace lamplighter
