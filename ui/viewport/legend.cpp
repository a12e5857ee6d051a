#include "ui/viewport/legend.h"

#include <algorithm>

#include "ui/theme.h"

namespace lamplighter {
namespace {

ImU32 packed(const vec3& c) { return ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, 1.0f}); }

float widthOf(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

}  // namespace

void drawLegend(const PanelContext& ui, ImDrawList& list, const Rect& area,
                const ViewPicture& picture) {
  Legend legend = picture.legend;
  if (!picture.problem.empty()) {
    legend = {};
    legend.title = "Not shown: " + picture.problem;
  } else if (legend.empty()) {
    return;
  }
  const float line = ImGui::GetTextLineHeight() + ui.px(4), gap = ui.px(7), pad = ui.px(10);
  const float square = ImGui::GetTextLineHeight() - ui.px(2);
  const float rampWidth = legend.ramp.empty() ? 0.0f : ui.px(190);
  float width = std::max(widthOf(legend.title), rampWidth);
  for (const Legend::Swatch& s : legend.swatches)
    width = std::max(width, square + gap + widthOf(s.label));
  const auto lines =
      static_cast<float>(1 + legend.swatches.size()) + (legend.ramp.empty() ? 0.0f : 2.0f);
  const ImVec2 high{area.min.x + 3 * pad + width, area.max.y - pad};
  const ImVec2 low{area.min.x + pad, high.y - lines * line - 2 * pad + ui.px(4)};
  list.AddRectFilled(low, high, theme::colour(theme::kBackground, 240), ui.px(5));
  list.AddRect(low, high, theme::colour(theme::kLine), ui.px(5));

  ImVec2 at{low.x + pad, low.y + pad};
  list.AddText(at, theme::colour(picture.problem.empty() ? theme::kText : theme::kWarning),
               legend.title.c_str());
  at.y += line;
  if (!legend.ramp.empty()) {
    const auto steps = static_cast<float>(legend.ramp.size() - 1);
    const float bottom = at.y + square;
    for (size_t i = 0; i + 1 < legend.ramp.size(); ++i) {
      const float left = at.x + rampWidth * static_cast<float>(i) / steps;
      const float right = at.x + rampWidth * static_cast<float>(i + 1) / steps;
      const ImU32 a = packed(legend.ramp[i]), b = packed(legend.ramp[i + 1]);
      list.AddRectFilledMultiColor({left, at.y}, {right, bottom}, a, b, b, a);
    }
    at.y += line;
    list.AddText(at, theme::colour(theme::kTextDim), legend.low.c_str());
    list.AddText({at.x + rampWidth - widthOf(legend.high), at.y}, theme::colour(theme::kTextDim),
                 legend.high.c_str());
    at.y += line;
  }
  for (const Legend::Swatch& s : legend.swatches) {
    list.AddRectFilled(at, {at.x + square, at.y + square}, packed(s.colour), ui.px(2));
    list.AddRect(at, {at.x + square, at.y + square}, theme::colour(theme::kTextDim, 130), ui.px(2));
    list.AddText({at.x + square + gap, at.y}, theme::colour(theme::kTextDim), s.label.c_str());
    at.y += line;
  }
}

}  // namespace lamplighter
