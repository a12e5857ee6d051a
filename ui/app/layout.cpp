#include "ui/app/layout.h"

#include <algorithm>
#include <cmath>

#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

constexpr float kToolbarHeight = 38.0f, kStatusHeight = 28.0f, kBorder = 4.0f;
constexpr float kLeastPanel = 150.0f, kLeastView = 160.0f, kLeastBottom = 120.0f;

}  // namespace

void Layout::divide(vec2 window, float menuHeight, float scale, bool showsBottom) {
  scale_ = scale;
  const auto px = [&](float designPixels) { return std::round(designPixels * scale); };
  // The view keeps a minimum size at any window size.
  const float most = std::max(window.x / scale - kLeastView, 2 * kLeastPanel);
  shown_ = sizes_;
  // Names can be cut and scrolled, fields cannot. So the left column shrinks first.
  shown_.left = std::clamp(sizes_.left, kLeastPanel, std::max(most - sizes_.right, kLeastPanel));
  shown_.right = std::clamp(sizes_.right, kLeastPanel, most - shown_.left);
  shown_.renderShare = std::clamp(sizes_.renderShare, 0.15f, 0.85f);

  const float top = menuHeight + px(kToolbarHeight);
  const float lowest = window.y - px(kStatusHeight);
  const float border = px(kBorder);
  toolbar = {{0, menuHeight}, {window.x, top}};
  status = {{0, lowest}, window};
  float viewBottom = lowest;
  left = {{0, top}, {px(shown_.left), viewBottom}};
  const float rightEdge = window.x - px(shown_.right);
  bottom = {};
  if (showsBottom) {
    shown_.bottom = std::clamp(sizes_.bottom, kLeastBottom,
                               std::max((viewBottom - top) / scale - kLeastView, kLeastBottom));
    bottom = {{0, viewBottom - px(shown_.bottom)}, {rightEdge - border, viewBottom}};
    viewBottom = bottom.min.y - border;
    left.max.y = viewBottom;
  }
  view = {{left.max.x + border, top}, {rightEdge - border, viewBottom}};
  const float middle = std::round(lowest - shown_.renderShare * (lowest - top));
  inspector = {{rightEdge, top}, {window.x, middle - border / 2}};
  render = {{rightEdge, middle + border / 2}, {window.x, lowest}};
}

void Layout::splitters(PanelContext ui) {
  ui.prefix = "splitter/";
  const float height = render.max.y - inspector.min.y;
  splitter(ui, "left", {{left.max.x, left.min.y}, {view.min.x, left.max.y}}, true, 1.0f / scale_,
           &LayoutSizes::left);
  splitter(ui, "right", {{view.max.x, view.min.y}, {render.min.x, view.max.y}}, true,
           -1.0f / scale_, &LayoutSizes::right);
  if (!bottom.empty()) {
    splitter(ui, "bottom", {{0, view.max.y}, {bottom.max.x, bottom.min.y}}, false, -1.0f / scale_,
             &LayoutSizes::bottom);
  }
  splitter(ui, "render", {{render.min.x, inspector.max.y}, {render.max.x, render.min.y}}, false,
           -1.0f / std::max(height, 1.0f), &LayoutSizes::renderShare);
}

void Layout::splitter(const PanelContext& ui, const char* name, const Rect& handle, bool vertical,
                      float direction, float LayoutSizes::*size) {
  if (handle.empty()) return;
  ImGui::SetNextWindowPos({handle.min.x, handle.min.y});
  ImGui::SetNextWindowSize({handle.size().x, handle.size().y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::colour(theme::kBackground));
  ImGui::Begin((std::string("##splitter ") + name).c_str(), nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoNavFocus);
  ImGui::InvisibleButton(name, {handle.size().x, handle.size().y});
  ui.name(name);
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    ImGui::GetWindowDrawList()->AddRectFilled({handle.min.x, handle.min.y},
                                              {handle.max.x, handle.max.y},
                                              theme::colour(theme::kAccent, 140));
  }
  if (ImGui::IsItemActive()) {
    const ImVec2 delta = ImGui::GetIO().MouseDelta;
    const float moved = vertical ? delta.x : delta.y;
    if (moved != 0.0f) sizes_.*size = shown_.*size + moved * direction;
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

}  // namespace lamplighter
