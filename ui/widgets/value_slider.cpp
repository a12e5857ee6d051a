#include "ui/widgets/value_slider.h"

#include <algorithm>
#include <cmath>

#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

// The values that ImGui uses instead of 0 on logarithmic scales: one decimal for integers, three
// for real numbers.
constexpr float kLeastInt = 0.1f, kLeastReal = 0.001f;

// Draws the slider over the filled part of the field. The fill is drawn last, when the value of
// this frame is known.
template <typename Slider, typename Share>
bool filled(const Slider& slider, const Share& share) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImDrawListSplitter layers;  // its own splitter, because tables use that of the list
  layers.Split(&list, 2);
  layers.SetCurrentChannel(&list, 1);
  for (const ImGuiCol c : {ImGuiCol_FrameBg, ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive,
                           ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive})
    ImGui::PushStyleColor(c, theme::colour(0, 0));
  const bool changed = slider();
  ImGui::PopStyleColor(5);

  layers.SetCurrentChannel(&list, 0);
  const bool isActive = ImGui::IsItemActive(), isHovered = ImGui::IsItemHovered();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const float rounding = ImGui::GetStyle().FrameRounding;
  list.AddRectFilled(low, high,
                     ImGui::GetColorU32(isHovered ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg),
                     rounding);
  const float x = low.x + std::round(share() * (high.x - low.x));
  if (x > low.x) {
    list.PushClipRect(low, {x, high.y}, true);
    list.AddRectFilled(low, high, theme::colour(theme::kAccent, isActive ? 100 : 56), rounding);
    list.PopClipRect();
  }
  layers.Merge(&list);
  return changed;
}

}  // namespace

float sliderShare(float value, float low, float high, bool logarithmic, float least) {
  if (!(high > low)) return 0.0f;
  float share = (value - low) / (high - low);
  if (logarithmic && low >= 0.0f) {
    const float from = std::max(low, least);
    share = value <= from ? 0.0f : std::log(value / from) / std::log(high / from);
  }
  return std::clamp(share, 0.0f, 1.0f);
}

bool valueSlider(const char* id, int& value, int low, int high, const char* format,
                 ImGuiSliderFlags flags) {
  return filled([&] { return ImGui::SliderInt(id, &value, low, high, format, flags); },
                [&] {
                  return sliderShare(static_cast<float>(value), static_cast<float>(low),
                                     static_cast<float>(high),
                                     (flags & ImGuiSliderFlags_Logarithmic) != 0, kLeastInt);
                });
}

bool valueSlider(const char* id, float& value, float low, float high, const char* format,
                 ImGuiSliderFlags flags) {
  return filled([&] { return ImGui::SliderFloat(id, &value, low, high, format, flags); },
                [&] {
                  return sliderShare(value, low, high, (flags & ImGuiSliderFlags_Logarithmic) != 0,
                                     kLeastReal);
                });
}

}  // namespace lamplighter
