// Display colours (sRGB-encoded) of the debug views, in [0, 1].
#pragma once

#include <string>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter::view_colours {

inline constexpr vec3 kBackground{0.11f, 0.115f, 0.125f};  // nothing is hit
inline constexpr vec3 kNoData{0.30f, 0.31f, 0.33f};  // surfaces for which the view has no data
inline constexpr vec3 kAway{0.19f, 0.20f, 0.22f};    // back faces
inline constexpr vec3 kNone{0.36f, 0.72f, 0.40f};
inline constexpr vec3 kPartial{0.95f, 0.78f, 0.26f};
inline constexpr vec3 kFull{0.80f, 0.27f, 0.24f};
inline constexpr vec3 kSettled{0.25f, 0.33f, 0.40f};

// From dark blue through green and yellow to red; t in [0, 1].
vec3 ramp(float t);
// The part of the ramp from `from` to 1, for a legend.
std::vector<vec3> rampSteps(float from = 0.0f);

// A colour for each patch; patches with neighbouring indices get different colours.
vec3 ofPatch(uint32_t object, int patch);

// The smallest of 1, 2, 5, 10, 20, 50, … that is not less than `value`; at least 1.
int niceMaximum(int value);

}  // namespace lamplighter::view_colours
