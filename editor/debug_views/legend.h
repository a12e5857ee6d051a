// What the colours of a view mean, as an overlay: the viewport draws it, and pictures hold it.
#pragma once

#include <functional>
#include <string>

#include "editor/tools/overlay.h"
#include "renderer/debug_views/view_picture.h"

namespace lamplighter {

// How the one who draws it writes.
struct LegendStyle {
  float scale = 1.0f;  // pixels a design pixel
  float textHeight = 0.0f;
  std::function<float(const std::string&)> textWidth;
};

struct LegendLayout {
  Overlay overlay;  // from (0, 0)
  vec2 size{0.0f};  // 0: the view has no legend
};

// Title, ramp and swatches from left to right, in as many rows as `width` asks for; 0: one below
// the other. Where the view could not be made it says why.
LegendLayout layOutLegend(const ViewPicture& picture, const LegendStyle& style, float width);

}  // namespace lamplighter
