// Colours, spacing, fonts and icons.
#pragma once

#include <imgui.h>

#include "editor/debug_views/look.h"

namespace lamplighter::theme {

// Loads the fonts (Inter and Fork Awesome from Debian's paths, or ImGui's own font if they are
// missing) and sets all colours and sizes. `scale`: pixels per design pixel.
void apply(float scale);

// Whether the icon font was found. Without it, only labels are shown.
bool hasIcons();

inline constexpr ImU32 colour(unsigned rgb, unsigned alpha = 255) {
  return IM_COL32((rgb >> 16) & 255, (rgb >> 8) & 255, rgb & 255, alpha);
}
using namespace look;  // NOLINT: for theme::kText etc.

}  // namespace lamplighter::theme
