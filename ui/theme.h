// Colours, spacing, fonts and icons.
#pragma once

#include <imgui.h>

namespace lamplighter::theme {

// Loads the fonts (Inter and Fork Awesome where Debian's packages put them, ImGui's own font where
// they are absent) and sets all colours and sizes; `scale` is pixels a design pixel.
void apply(float scale);

// Whether the icon font was found; without it icons are left out and labels stand alone.
bool hasIcons();

inline constexpr ImU32 colour(unsigned rgb, unsigned alpha = 255) {
  return IM_COL32((rgb >> 16) & 255, (rgb >> 8) & 255, rgb & 255, alpha);
}
inline constexpr unsigned kBackground = 0x17181b;
inline constexpr unsigned kPanel = 0x1f2125;
inline constexpr unsigned kHeader = 0x2a2d33;
inline constexpr unsigned kFrame = 0x2c3037;
inline constexpr unsigned kFrameHovered = 0x383d46;
inline constexpr unsigned kFrameActive = 0x444a55;
inline constexpr unsigned kLine = 0x34383f;
inline constexpr unsigned kText = 0xe3e5e8;
inline constexpr unsigned kTextDim = 0x9aa0a9;
inline constexpr unsigned kAccent = 0xe9a94b;  // lamplight
inline constexpr unsigned kGood = 0x7fc18a;
inline constexpr unsigned kWarning = 0xf0c05a;

inline constexpr float kFontSize = 15.0f;  // design pixels

}  // namespace lamplighter::theme
