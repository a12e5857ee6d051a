#include "ui/panels/dialogs/recovery_dialog.h"

#include <algorithm>
#include <ctime>

namespace lamplighter {

namespace {

// "2026-03-01 14:05", in local time.
std::string timeText(int64_t secondsSince1970) {
  const std::time_t time = secondsSince1970;
  std::tm local{};
  localtime_r(&time, &local);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local)};
}

void line(const PanelContext& ui, const char* label, const std::string& value) {
  ImGui::TextDisabled("%s", label);
  ImGui::SameLine(ui.px(70));
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(value.c_str());
  ImGui::PopTextWrapPos();
}

}  // namespace

RecoveryDialog::Answer RecoveryDialog::draw(PanelContext ui) {
  constexpr const char* kTitle = "Recover unsaved work?";
  ui.prefix = "recovery/";
  const auto& found = ui.session.crashRecovery().found();
  if (later_ || found.empty()) return Answer::none;
  if (!ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(ui.px(480), 0.96f * ImGui::GetMainViewport()->Size.x), 0});
  if (!beginBorderedModal(kTitle, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings))
    return Answer::none;
  const Recoverable& newest = found.front();
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted("Lamplighter ended before these changes were saved:");
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, ui.px(2)});
  line(ui, "Level", newest.scene.empty() ? "untitled" : newest.scene.filename().string());
  if (newest.scene.has_parent_path())
    line(ui, "In", endOf(newest.scene.parent_path().string(), ui.px(370)));
  line(ui, "Edits", grouped(newest.edits));
  line(ui, "Last at", timeText(newest.time));
  if (found.size() > 1) note("And " + std::to_string(found.size() - 1) + " more after this one.");
  ImGui::Dummy({0, ui.px(6)});
  Answer answer = Answer::none;
  const float width = ui.px(96);
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 3 * width - 2 * ui.px(7));
  if (ImGui::Button("Later", {width, 0}) ||
      ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false))
    later_ = true;
  ui.name("later");
  tooltip(ui, "Keeps the recovery file. The next start asks again.");
  ImGui::SameLine(0, ui.px(7));
  if (ImGui::Button("Discard", {width, 0})) answer = Answer::discard;
  ui.name("discard");
  ImGui::SameLine(0, ui.px(7));
  if (ImGui::Button("Recover", {width, 0}) ||
      ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false))
    answer = Answer::recover;
  ui.name("recover");
  // Only one level can be open. The others are offered at the next start.
  if (answer == Answer::recover) later_ = true;
  if (later_ || answer != Answer::none) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return answer;
}

}  // namespace lamplighter
