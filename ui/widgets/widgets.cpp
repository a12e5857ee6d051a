#include "ui/widgets/widgets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

// For the hover time of an item, which imgui.h of 1.86 does not declare.
#include <imgui_internal.h>

#include "ui/widgets/theme.h"

namespace lamplighter {

float PanelContext::px(float designPixels) const { return std::round(designPixels * scale); }

void PanelContext::name(const std::string& widget) const {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  const ImVec2 clipLow = ImGui::GetWindowDrawList()->GetClipRectMin();
  const ImVec2 clipHigh = ImGui::GetWindowDrawList()->GetClipRectMax();
  const Rect rect{{low.x, low.y}, {high.x, high.y}};
  const Rect visible{{std::max(low.x, clipLow.x), std::max(low.y, clipLow.y)},
                     {std::min(high.x, clipHigh.x), std::min(high.y, clipHigh.y)}};
  widgets.add(prefix + widget, rect, visible);
}

float labelWidth(const PanelContext& ui) { return ui.px(112); }

void labelledRow(const PanelContext& ui, const char* label, const char* help) {
  ImGui::AlignTextToFramePadding();
  const float start = ImGui::GetCursorPosX();
  colouredText(label, theme::kTextDim);
  if (help) tooltip(ui, help);
  ImGui::SameLine(start + labelWidth(ui));
  ImGui::SetNextItemWidth(-FLT_MIN);
}

void tooltip(const PanelContext& ui, const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  // A delay, so that a pointer that only passes does not open tooltips.
  constexpr float kWait = 0.5f;  // seconds
  const ImGuiContext& imgui = *ImGui::GetCurrentContext();
  if (ImGui::IsAnyItemActive() || (imgui.HoveredId != 0 && imgui.HoveredIdTimer < kWait)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ui.px(320));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool section(const PanelContext& ui, const char* label, bool openAtFirst) {
  ImGui::PushStyleColor(ImGuiCol_Header, theme::colour(theme::kHeader));
  ImGui::SetNextItemOpen(openAtFirst, ImGuiCond_FirstUseEver);
  const bool open = ImGui::CollapsingHeader(label);
  ImGui::PopStyleColor();
  ui.name(std::string("section ") + label);
  return open;
}

Rect windowRect() {
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  return {{at.x, at.y}, {at.x + size.x, at.y + size.y}};
}

bool beginBorderedModal(const char* title, ImGuiWindowFlags flags) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_Border, theme::colour(theme::kFrameActive));
  const bool open = ImGui::BeginPopupModal(title, nullptr, flags);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  return open;
}

std::string endOf(const std::string& text, float room) {
  if (ImGui::CalcTextSize(text.c_str()).x <= room) return text;
  size_t first = 0;
  std::string shown;
  do {
    ++first;
    while (first < text.size() && (static_cast<unsigned char>(text[first]) & 0xc0) == 0x80) ++first;
    shown = "\u2026" + text.substr(first);
  } while (first < text.size() && ImGui::CalcTextSize(shown.c_str()).x > room);
  return shown;
}

void colouredText(const std::string& text, unsigned colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(colour));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

void rightAligned(const std::string& text, unsigned colour) {
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  if (room > 0.0f) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
  colouredText(text, colour);
}

float heightOfRows(const PanelContext& ui, float rows) {
  const float row = ImGui::GetTextLineHeight() + 2.0f * ImGui::GetStyle().CellPadding.y;
  return std::ceil(rows * (row + ui.px(1)) + ui.px(4));
}

void beginOverlay(const PanelContext& ui, const char* id) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(5));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::Begin(
      id, nullptr,
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  ImGui::PopStyleVar(2);
}

void note(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(theme::kTextDim));
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

std::string withIcon(const char* icon, const std::string& label) {
  if (!theme::hasIcons()) return label;
  return label.empty() ? std::string(icon) : std::string(icon) + "  " + label;
}

void trackEdit(const PanelContext& ui, const std::string& label) {
  if (ImGui::IsItemActivated()) ui.session.editing().hold(label);
  if (ImGui::IsItemDeactivated()) ui.session.editing().commit();
}

bool dragField(const PanelContext& ui, const std::string& widget, float& value, float speed,
               const char* format, float minimum, float maximum) {
  const std::string id = "##" + widget;
  const bool changed = ImGui::DragFloat(id.c_str(), &value, speed, minimum, maximum, format,
                                        ImGuiSliderFlags_NoRoundToFormat);
  ui.name(widget);
  return changed && std::isfinite(value);
}

bool dragVector(const PanelContext& ui, const std::string& widget, const std::string& step,
                vec3& value, float speed, const char* format) {
  static constexpr unsigned kAxisColours[3] = {0xc8574f, 0x74a84f, 0x4f80c8};
  static constexpr const char* kAxes[3] = {"x", "y", "z"};
  const float gap = ui.px(5);
  const float whole = ImGui::GetContentRegionAvail().x;
  const float width = std::floor((whole - 2 * gap) / 3);
  bool changed = false;
  for (int i = 0; i < 3; ++i) {
    if (i > 0) ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(i < 2 ? width : whole - 2 * (width + gap));
    changed |= dragField(ui, widget + "." + kAxes[i], value[i], speed, format);
    trackEdit(ui, step);
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + ui.px(3), high.y},
                                              theme::colour(kAxisColours[i]), ui.px(2),
                                              ImDrawFlags_RoundCornersLeft);
  }
  return changed;
}

int combo(const PanelContext& ui, const std::string& widget, const std::string& shown,
          std::span<const ComboItem> items, int current) {
  const bool open = ImGui::BeginCombo(("##" + widget).c_str(), shown.c_str());
  ui.name(widget);
  int chosen = kNone;
  if (!open) return chosen;
  for (int i = 0; i < static_cast<int>(items.size()); ++i) {
    const ComboItem& item = items[static_cast<size_t>(i)];
    ImGui::PushID(i);
    if (ImGui::Selectable(item.label.c_str(), i == current,
                          item.enabled ? 0 : ImGuiSelectableFlags_Disabled))
      chosen = i;
    ImGui::PopID();
    ui.name(widget + "/" + item.name);
    tooltip(ui, item.help);
  }
  ImGui::EndCombo();
  return chosen;
}

int combo(const PanelContext& ui, const std::string& widget, const std::string& shown,
          std::span<const std::string> choices) {
  std::vector<ComboItem> items;
  for (const std::string& choice : choices) items.push_back({choice, choice});
  const auto current = std::find(choices.begin(), choices.end(), shown);
  return combo(ui, widget, shown, items, static_cast<int>(current - choices.begin()));
}

bool toggleButton(const std::string& label, bool on, const ImVec2& size) {
  if (on) {
    ImGui::PushStyleColor(ImGuiCol_Button, theme::colour(theme::kAccent, 60));
    ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(theme::kAccent));
  }
  const bool clicked = ImGui::Button(label.c_str(), size);
  if (on) ImGui::PopStyleColor(2);
  return clicked;
}

vec3 linearToSrgb(const vec3& c) {
  vec3 out;
  for (int i = 0; i < 3; ++i)
    out[i] = c[i] <= 0.0031308f ? 12.92f * c[i] : 1.055f * std::pow(c[i], 1.0f / 2.4f) - 0.055f;
  return out;
}

vec3 srgbToLinear(const vec3& c) {
  vec3 out;
  for (int i = 0; i < 3; ++i)
    out[i] = c[i] <= 0.04045f ? c[i] / 12.92f : std::pow((c[i] + 0.055f) / 1.055f, 2.4f);
  return out;
}

std::string grouped(long long value) {
  std::string digits = std::to_string(value < 0 ? -value : value);
  for (int i = static_cast<int>(digits.size()) - 3; i > 0; i -= 3)
    digits.insert(static_cast<size_t>(i), 1, ',');
  if (value < 0) digits.insert(digits.begin(), '-');
  return digits;
}

std::string short3(double value) {
  if (!std::isfinite(value)) return "?";
  const double size = std::abs(value);
  if (size >= 1000) {
    const double unit = std::pow(10.0, std::floor(std::log10(size)) - 2);
    return grouped(std::llround(std::round(value / unit) * unit));
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace lamplighter
