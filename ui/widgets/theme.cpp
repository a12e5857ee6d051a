#include "ui/widgets/theme.h"

#include <cmath>
#include <filesystem>

#include "ui/widgets/icons.h"

namespace lamplighter::theme {
namespace {

constexpr const char* kIconFont = "/usr/share/fonts/truetype/fork-awesome/forkawesome-webfont.ttf";

ImVec4 rgb(unsigned value, float alpha = 1.0f) {
  return {static_cast<float>((value >> 16) & 255) / 255.0f,
          static_cast<float>((value >> 8) & 255) / 255.0f, static_cast<float>(value & 255) / 255.0f,
          alpha};
}

void loadFonts(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  const float size = std::round(kFontSize * scale);
  // Latin with its supplements, general punctuation, superscripts, arrows and mathematical signs.
  static constexpr ImWchar kText[] = {0x20,   0x17f,  0x2010, 0x2027, 0x2030, 0x2044,
                                      0x2070, 0x209c, 0x2190, 0x2193, 0x2212, 0x2212,
                                      0x2248, 0x2265, 0x3bb,  0x3c1,  0};
  std::error_code ignored;
  if (!std::filesystem::exists(kTextFont, ignored) ||
      !io.Fonts->AddFontFromFileTTF(kTextFont, size, nullptr, kText)) {
    ImFontConfig config;
    config.SizePixels = std::round(13.0f * scale);
    io.Fonts->AddFontDefault(&config);
  }
  if (!std::filesystem::exists(kIconFont, ignored)) return;
  static constexpr ImWchar kIcons[] = {icon::kFirst, icon::kLast, 0};
  ImFontConfig config;
  config.MergeMode = true;
  // the same width for all icons, so that labels are aligned
  config.GlyphMinAdvanceX = std::round(size * 1.15f);
  io.Fonts->AddFontFromFileTTF(kIconFont, std::round(size * 0.95f), &config, kIcons);
}

void setColours(ImGuiStyle& style) {
  ImVec4* c = style.Colors;
  c[ImGuiCol_Text] = rgb(kText);
  c[ImGuiCol_TextDisabled] = rgb(kTextDim);
  c[ImGuiCol_WindowBg] = rgb(kPanel);
  c[ImGuiCol_ChildBg] = rgb(kPanel, 0.0f);
  c[ImGuiCol_PopupBg] = rgb(0x25282d);
  c[ImGuiCol_Border] = rgb(kLine);
  c[ImGuiCol_BorderShadow] = rgb(0, 0.0f);
  c[ImGuiCol_FrameBg] = rgb(kFrame);
  c[ImGuiCol_FrameBgHovered] = rgb(kFrameHovered);
  c[ImGuiCol_FrameBgActive] = rgb(kFrameActive);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = rgb(kHeader);
  c[ImGuiCol_MenuBarBg] = rgb(kBackground);
  c[ImGuiCol_ScrollbarBg] = rgb(kPanel, 0.0f);
  c[ImGuiCol_ScrollbarGrab] = rgb(kFrameHovered);
  c[ImGuiCol_ScrollbarGrabHovered] = rgb(kFrameActive);
  c[ImGuiCol_ScrollbarGrabActive] = rgb(kAccent);
  c[ImGuiCol_CheckMark] = rgb(kAccent);
  c[ImGuiCol_SliderGrab] = rgb(0x6f6350);
  c[ImGuiCol_SliderGrabActive] = rgb(kAccent);
  c[ImGuiCol_Button] = rgb(kFrame);
  c[ImGuiCol_ButtonHovered] = rgb(kFrameHovered);
  c[ImGuiCol_ButtonActive] = rgb(kFrameActive);
  c[ImGuiCol_Header] = rgb(kAccent, 0.22f);
  c[ImGuiCol_HeaderHovered] = rgb(kFrameHovered);
  c[ImGuiCol_HeaderActive] = rgb(kFrameActive);
  c[ImGuiCol_Separator] = rgb(kLine);
  c[ImGuiCol_SeparatorHovered] = c[ImGuiCol_SeparatorActive] = rgb(kAccent);
  c[ImGuiCol_TextSelectedBg] = rgb(kAccent, 0.35f);
  c[ImGuiCol_PlotHistogram] = rgb(kAccent);
  c[ImGuiCol_NavHighlight] = rgb(kAccent);
  c[ImGuiCol_ModalWindowDimBg] = rgb(0x000000, 0.55f);
}

}  // namespace

void apply(float scale) {
  ImGuiStyle style;
  style.WindowPadding = {10, 8};
  style.FramePadding = {7, 4};
  style.ItemSpacing = {7, 5};
  style.ItemInnerSpacing = {6, 4};
  style.IndentSpacing = 14;
  style.ScrollbarSize = 11;
  style.GrabMinSize = 9;
  style.WindowRounding = 0;
  style.ChildRounding = 3;
  style.FrameRounding = 3;
  style.PopupRounding = 4;
  style.GrabRounding = 2;
  style.ScrollbarRounding = 5;
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.WindowMinSize = {8, 8};
  style.WindowTitleAlign = {0, 0.5f};
  style.ScaleAllSizes(scale);
  setColours(style);
  ImGui::GetStyle() = style;
  loadFonts(scale);
}

bool hasIcons() { return ImGui::GetFont()->FindGlyphNoFallback(icon::kProbe) != nullptr; }

}  // namespace lamplighter::theme
