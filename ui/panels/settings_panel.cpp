// The user's settings, generated from their declarations, and the bound keys.
#include <algorithm>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/session/user_state.h"
#include "ui/panels/panels.h"
#include "ui/panels/user_panels.h"
#include "ui/widgets/value_slider.h"

namespace lamplighter {
namespace {

void values(const PanelContext& ui, Requests& requests) {
  const Settings& settings = ui.session.home().preferences.values;
  for (const PreferenceSection& part : preferenceSections()) {
    if (!section(ui, part.label.c_str(), part.isOpen)) continue;
    for (const ParameterSpec& spec : part.table.specs()) {
      labelledRow(ui, spec.label.c_str(), spec.help.c_str());
      if (const auto& offered = offeredValues(spec.name); !offered.empty()) {
        const std::string now = Settings::format(settings.real(spec));
        const int chosen = combo(ui, spec.name, now, offered);
        if (chosen != kNone)
          requests.actions.push_back("settings.set " + spec.name + "=" +
                                     offered[static_cast<size_t>(chosen)]);
      } else if (const auto value = parameterField(ui, spec, settings, false)) {
        requests.actions.push_back("settings.set " + spec.name + "=" + Settings::format(*value));
      }
      tooltip(ui, spec.help);
    }
  }
}

void keyTable(const PanelContext& ui, SettingsState& state) {
  if (!section(ui, "Keys")) return;
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::InputTextWithHint("##search", "Search actions and keys", &state.search);
  ui.name("key_search");
  const auto lower = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  const std::string wanted = lower(state.search);
  ImGui::BeginChild("keys", {0, ui.px(150)}, true);
  for (const auto& [name, action] : ui.session.actions().all()) {
    if (action.shortcut.empty()) continue;
    if (lower(name + " " + action.label + " " + action.shortcut).find(wanted) == std::string::npos)
      continue;
    ImGui::TextUnformatted(action.shortcut.c_str());
    ImGui::SameLine(ui.px(170));
    ImGui::TextUnformatted(action.label.c_str());
    ImGui::SameLine(ui.px(360));
    ImGui::TextColored(ImGui::GetStyle().Colors[ImGuiCol_TextDisabled], "%s", name.c_str());
  }
  ImGui::EndChild();
  note(
      "Single actions are bound in keys.json beside the settings file: "
      "docs/reference/settings.md.");
}

}  // namespace

void settingsDialog(PanelContext ui, SettingsState& state, Requests& requests) {
  ui.prefix = "settings/";
  bool& shows = ui.session.home().showsSettings;
  constexpr const char* kTitle = "Settings###settings";
  if (shows && !ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
  const ImVec2 window = ImGui::GetMainViewport()->Size;
  ImGui::SetNextWindowSize(
      {std::min(ui.px(560), 0.96f * window.x), std::min(ui.px(620), 0.92f * window.y)});
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5f, 0.5f});
  if (!beginBorderedModal(kTitle, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) return;
  ImGui::BeginChild("values", {0, -ImGui::GetFrameHeightWithSpacing() - ui.px(4)}, false,
                    ImGuiWindowFlags_NavFlattened);
  values(ui, requests);
  keyTable(ui, state);
  ImGui::EndChild();
  if (ImGui::Button("Reset all")) requests.actions.push_back("settings.reset");
  ui.name("reset");
  const float width = ui.px(96);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
  const bool isPopupOpen = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId) &&
                           !ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows);
  const bool escapes = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false) &&
                       !ImGui::IsAnyItemActive() && !isPopupOpen;
  if (ImGui::Button("Close", {width, 0}) || escapes) {
    shows = false;
    ImGui::CloseCurrentPopup();
  }
  ui.name("close");
  ImGui::EndPopup();
}

}  // namespace lamplighter
