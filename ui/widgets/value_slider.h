// Sliders that fill their field up to the value and show the number over it. They have no handle,
// because it would hide the digits.
#pragma once

#include "ui/widgets/widgets.h"

namespace lamplighter {

// Returns true if the value changed. Ctrl+click allows typing a value.
bool valueSlider(const char* id, int& value, int low, int high, const char* format,
                 ImGuiSliderFlags flags = 0);
bool valueSlider(const char* id, float& value, float low, float high, const char* format,
                 ImGuiSliderFlags flags = 0);

// The position of a value on a slider from low to high, from 0 to 1, computed as ImGui does.
// `least`: the value that a logarithmic scale uses instead of 0.
float sliderShare(float value, float low, float high, bool logarithmic, float least);

}  // namespace lamplighter
