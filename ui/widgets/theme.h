// Colours, spacing, fonts and icons.
#pragma once

#include <imgui.h>

#include "editor/debug_views/look.h"

namespace lamplighter::theme {

// Loads the fonts (Inter and Fork Awesome where Debian's packages put them, ImGui's own font where
// they are absent) and sets all colours and sizes; `scale` is pixels a design pixel.
void apply(float scale);

// Whether the icon font was found; without it icons are left out and labels stand alone.
bool hasIcons();

inline constexpr ImU32 colour(unsigned rgb, unsigned alpha = 255) {
  return IM_COL32((rgb >> 16) & 255, (rgb >> 8) & 255, rgb & 255, alpha);
}
using namespace look;  // NOLINT: theme::kText and the like

}  // namespace lamplighter::theme
