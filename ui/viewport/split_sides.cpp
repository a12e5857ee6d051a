#include "ui/viewport/split_sides.h"

#include <cmath>

#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

float dividerOf(const Rect& area, const SplitView& split) {
  return std::round(area.min.x + split.position() * area.size().x);
}

// A name on a dark background. `right`: it ends at `x`, otherwise it starts there.
void plate(const PanelContext& ui, ImDrawList& list, float x, float y, bool right,
           const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float pad = ui.px(6);
  const float left = right ? x - size.x - 2 * pad : x;
  list.AddRectFilled({left, y}, {left + size.x + 2 * pad, y + size.y + pad},
                     theme::colour(theme::kBackground, 210), ui.px(4));
  list.AddText({left + pad, y + pad / 2}, theme::colour(theme::kText), text.c_str());
}

}  // namespace

void drawSecondSide(const PanelContext&, ImDrawList& list, const Rect& area, const SplitView& split,
                    uint32_t texture) {
  using Shown = SplitView::Shown;
  if (texture == 0 || split.shown() == Shown::first || split.shown() == Shown::heat) return;
  const float from = split.shown() == Shown::second ? area.min.x : dividerOf(area, split);
  list.PushClipRect({from, area.min.y}, {area.max.x, area.max.y}, true);
  list.AddImage(reinterpret_cast<ImTextureID>(static_cast<intptr_t>(texture)),
                {area.min.x, area.min.y}, {area.max.x, area.max.y});
  list.PopClipRect();
}

void drawSplitLabels(const PanelContext& ui, ImDrawList& list, const Rect& area,
                     const SplitView& split) {
  using Shown = SplitView::Shown;
  const float gap = ui.px(8), y = area.min.y + gap;
  const std::string waits = split.settled() ? "" : " \u2026";
  if (split.shown() == Shown::heat) return;  // the legend describes the heat map
  if (split.shown() != Shown::both) {
    const bool isFirst = split.shown() == Shown::first;
    plate(ui, list, area.min.x + gap, y, false,
          isFirst ? "A: " + split.first().text : "B: " + split.second().text + waits);
    return;
  }
  const float x = dividerOf(area, split);
  const unsigned colour = split.hot() ? theme::kAccent : theme::kText;
  list.AddLine({x, area.min.y}, {x, area.max.y}, theme::colour(0x000000, 120), ui.px(4));
  list.AddLine({x, area.min.y}, {x, area.max.y}, theme::colour(colour), ui.px(2));
  const float middle = 0.5f * (area.min.y + area.max.y), r = ui.px(9), arrow = ui.px(4);
  list.AddCircleFilled({x, middle}, r, theme::colour(theme::kBackground, 230));
  list.AddCircle({x, middle}, r, theme::colour(colour), 0, ui.px(2));
  for (const float side : {-1.0f, 1.0f})
    list.AddTriangleFilled({x + side * ui.px(6), middle}, {x + side * ui.px(2), middle - arrow},
                           {x + side * ui.px(2), middle + arrow}, theme::colour(colour));
  plate(ui, list, x - gap, y, true, "A: " + split.first().text);
  plate(ui, list, x + gap, y, false, "B: " + split.second().text + waits);
  if (split.hot()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

void drawTileCaption(ImDrawList& list, const Rect& area, const SplitView& split, size_t side) {
  list.PushClipRect({area.min.x, area.min.y}, {area.max.x, area.max.y}, true);
  ImVec2 at{area.min.x, area.min.y + 0.5f * static_cast<float>(kTileGap)};
  list.AddText(at, theme::colour(theme::kText), split.title(side).c_str());
  for (const std::string& line : split.figures(side)) {
    at.y += ImGui::GetTextLineHeight();
    list.AddText(at, theme::colour(theme::kTextDim), line.c_str());
  }
  list.PopClipRect();
}

}  // namespace lamplighter
