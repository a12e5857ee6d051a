// Sliders whose field is filled as far as the value goes, with the number upon it: a handle would
// stand in the way of the digits.
#pragma once

#include "ui/widgets/widgets.h"

namespace lamplighter {

// True when it changed. Ctrl+click types a value.
bool valueSlider(const char* id, int& value, int low, int high, const char* format,
                 ImGuiSliderFlags flags = 0);
bool valueSlider(const char* id, float& value, float low, float high, const char* format,
                 ImGuiSliderFlags flags = 0);

// Where a slider from low to high stands at a value, from 0 to 1, as ImGui has it: `least` is what
// it takes for 0 on a logarithmic scale.
float sliderShare(float value, float low, float high, bool logarithmic, float least);

}  // namespace lamplighter
