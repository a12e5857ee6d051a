// The legend of a view, which explains its colours, as an overlay. The viewport and saved pictures
// use it.
#pragma once

#include <functional>
#include <string>

#include "editor/tools/overlay.h"
#include "renderer/debug_views/view_picture.h"

namespace lamplighter {

// Text size and metrics of the caller that draws the legend.
struct LegendStyle {
  float scale = 1.0f;  // pixels per design pixel
  float textHeight = 0.0f;
  std::function<float(const std::string&)> textWidth;
};

struct LegendLayout {
  Overlay overlay;  // from (0, 0)
  vec2 size{0.0f};  // 0: the view has no legend
};

// Title, ramp and swatches from left to right, in as many rows as `width` requires; 0: in one
// column. If the view could not be computed, the legend says why.
LegendLayout layOutLegend(const ViewPicture& picture, const LegendStyle& style, float width);

}  // namespace lamplighter
