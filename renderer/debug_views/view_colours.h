// Colours of views, of the display (sRGB-encoded), in [0, 1].
#pragma once

#include <string>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter::view_colours {

inline constexpr vec3 kBackground{0.11f, 0.115f, 0.125f};  // nothing is hit
inline constexpr vec3 kNoData{0.30f, 0.31f, 0.33f};        // surfaces that the view says nothing of
inline constexpr vec3 kAway{0.19f, 0.20f, 0.22f};          // backs
inline constexpr vec3 kNone{0.36f, 0.72f, 0.40f};
inline constexpr vec3 kPartial{0.95f, 0.78f, 0.26f};
inline constexpr vec3 kFull{0.80f, 0.27f, 0.24f};
inline constexpr vec3 kSettled{0.25f, 0.33f, 0.40f};

// From dark blue through green and yellow to red; t in [0, 1].
vec3 ramp(float t);
// The part of it from `from` to 1, as a legend shows it.
std::vector<vec3> rampSteps(float from = 0.0f);

// A colour for each patch, such that those with neighbouring numbers differ.
vec3 ofPatch(uint32_t object, int patch);

// The least of 1, 2, 5, 10, 20, 50, … that is not less; at least 1.
int niceMaximum(int value);

}  // namespace lamplighter::view_colours
