#include "ui/app/layout.h"

#include <algorithm>
#include <cmath>

#include "ui/theme.h"

namespace lamplighter {
namespace {

constexpr float kToolbarHeight = 38.0f, kStatusHeight = 28.0f, kBorder = 4.0f;
constexpr float kLeastPanel = 150.0f, kLeastView = 160.0f;

}  // namespace

void Layout::divide(vec2 window, float menuHeight, float scale) {
  scale_ = scale;
  const auto px = [&](float designPixels) { return std::round(designPixels * scale); };
  // The view keeps some room whatever the window's size.
  const float most = std::max(window.x / scale - kLeastView, 2 * kLeastPanel);
  leftWidth_ = std::clamp(leftWidth_, kLeastPanel, most - kLeastPanel);
  rightWidth_ = std::clamp(rightWidth_, kLeastPanel, most - leftWidth_);
  renderShare_ = std::clamp(renderShare_, 0.15f, 0.85f);

  const float top = menuHeight + px(kToolbarHeight);
  const float bottom = window.y - px(kStatusHeight);
  const float border = px(kBorder);
  toolbar = {{0, menuHeight}, {window.x, top}};
  status = {{0, bottom}, window};
  left = {{0, top}, {px(leftWidth_), bottom}};
  const float rightEdge = window.x - px(rightWidth_);
  view = {{left.max.x + border, top}, {rightEdge - border, bottom}};
  const float middle = std::round(bottom - renderShare_ * (bottom - top));
  inspector = {{rightEdge, top}, {window.x, middle - border / 2}};
  render = {{rightEdge, middle + border / 2}, {window.x, bottom}};
}

void Layout::splitters(PanelContext ui) {
  ui.prefix = "splitter/";
  const float height = render.max.y - inspector.min.y;
  splitter(ui, "left", {{left.max.x, left.min.y}, {view.min.x, left.max.y}}, true, 1.0f / scale_,
           leftWidth_);
  splitter(ui, "right", {{view.max.x, view.min.y}, {render.min.x, view.max.y}}, true,
           -1.0f / scale_, rightWidth_);
  splitter(ui, "render", {{render.min.x, inspector.max.y}, {render.max.x, render.min.y}}, false,
           -1.0f / std::max(height, 1.0f), renderShare_);
}

void Layout::splitter(const PanelContext& ui, const char* name, const Rect& handle, bool vertical,
                      float direction, float& value) {
  if (handle.empty()) return;
  ImGui::SetNextWindowPos({handle.min.x, handle.min.y});
  ImGui::SetNextWindowSize({handle.size().x, handle.size().y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::colour(theme::kBackground));
  ImGui::Begin((std::string("##splitter ") + name).c_str(), nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
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
    value += (vertical ? delta.x : delta.y) * direction;
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

}  // namespace lamplighter
