// Colours and font of the editor, for the window and for text drawn into pictures.
#pragma once

#include "renderer/base/math.h"

namespace lamplighter::look {

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

// The path of Debian's package fonts-inter.
inline constexpr const char* kTextFont = "/usr/share/fonts/opentype/inter/Inter-Regular.otf";

inline vec4 colour(unsigned rgb, float alpha = 1.0f) {
  return vec4(vec3((rgb >> 16) & 255, (rgb >> 8) & 255, rgb & 255) / 255.0f, alpha);
}

}  // namespace lamplighter::look
