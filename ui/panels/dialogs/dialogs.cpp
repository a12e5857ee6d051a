#include <algorithm>
#include <span>
#include <utility>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/actions/arguments.h"
#include "ui/panels/panels.h"
#include "ui/widgets/keyboard.h"

namespace lamplighter {
namespace {

bool beginModal(const PanelContext& ui, const char* title, float width) {
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(ui.px(width), 0.96f * ImGui::GetMainViewport()->Size.x), 0});
  return beginBorderedModal(title, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings);
}

void paragraph(const PanelContext& ui, const std::string& text) {
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, ui.px(6)});
}

struct AnswerButton {
  const char* label;
  const char* name;  // of the widget
};

// Shows the text and, below it at the right, a row of buttons. Closes the box and returns the index
// of the chosen button, or kNone. Escape chooses the first.
int choose(const PanelContext& ui, const std::string& text, std::span<const AnswerButton> choices) {
  paragraph(ui, text);
  const float width = ui.px(96), gap = ui.px(7);
  const auto count = static_cast<float>(choices.size());
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - count * width - (count - 1) * gap);
  int chosen = kNone;
  for (size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) ImGui::SameLine(0, gap);
    if (ImGui::Button(choices[i].label, {width, 0})) chosen = static_cast<int>(i);
    ui.name(choices[i].name);
  }
  if (chosen == kNone && pressed(ImGuiKey_Escape)) chosen = 0;
  if (chosen != kNone) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return chosen;
}

}  // namespace

void MessageBox::show(std::string title, std::string text) {
  title_ = std::move(title);
  text_ = std::move(text);
}

void MessageBox::draw(PanelContext ui) {
  ui.prefix = "dialog/";
  const std::string id = title_ + "###message";
  if (visible() && !ImGui::IsPopupOpen(id.c_str())) ImGui::OpenPopup(id.c_str());
  if (!beginModal(ui, id.c_str(), 460)) return;
  paragraph(ui, text_);
  const float width = ui.px(96);
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - width);
  if (ImGui::Button("OK", {width, 0}) || pressed(ImGuiKey_Enter) || pressed(ImGuiKey_Escape)) {
    text_.clear();
    ImGui::CloseCurrentPopup();
  }
  ui.name("ok");
  ImGui::EndPopup();
}

SaveQuestion::Answer SaveQuestion::draw(PanelContext ui) {
  ui.prefix = "dialog/";
  if (opening_) ImGui::OpenPopup("Unsaved changes");
  opening_ = false;
  if (!beginModal(ui, "Unsaved changes", 420)) return Answer::none;
  const std::string file = ui.session.document().path.filename().string();
  static constexpr AnswerButton kChoices[] = {
      {"Cancel", "cancel"}, {"Don't save", "discard"}, {"Save", "save"}};
  static constexpr Answer kAnswers[] = {Answer::cancel, Answer::discard, Answer::save};
  const int chosen = choose(
      ui,
      "Save the changes to " + (file.empty() ? "the scene" : file) + "? They are lost otherwise.",
      kChoices);
  return chosen == kNone ? Answer::none : kAnswers[chosen];
}

OverwriteQuestion::Answer OverwriteQuestion::draw(PanelContext ui) {
  constexpr const char* kTitle = "Changed on disk";
  ui.prefix = "dialog/";
  if (!changed_.empty() && !ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
  if (!beginModal(ui, kTitle, 460)) return Answer::none;
  static constexpr AnswerButton kChoices[] = {
      {"Cancel", "cancel"}, {"Overwrite", "overwrite"}, {"Save as\u2026", "save_as"}};
  static constexpr Answer kAnswers[] = {Answer::cancel, Answer::overwrite, Answer::saveAs};
  const int chosen = choose(ui,
                            changed_ +
                                " was changed or removed by another program since it was "
                                "opened. Overwriting it loses those changes.",
                            kChoices);
  if (chosen == kNone) return Answer::none;
  changed_.clear();
  return kAnswers[chosen];
}

void NameDialog::open(const std::string& action, const ActionAsk& asks, std::string name) {
  action_ = action;
  title_ = asks.title + "###name";
  name_ = std::move(name);
  opening_ = true;
}

std::string NameDialog::draw(PanelContext ui) {
  ui.prefix = "dialog/";
  if (opening_) ImGui::OpenPopup(title_.c_str());
  if (!beginModal(ui, title_.c_str(), 360)) return "";
  if (std::exchange(opening_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-FLT_MIN);
  bool done = ImGui::InputText(
      "##name", &name_, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  ui.name("name");
  const float width = ui.px(96), gap = ui.px(7);
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 2 * width - gap);
  const bool cancelled = ImGui::Button("Cancel", {width, 0}) || pressed(ImGuiKey_Escape);
  ui.name("cancel");
  ImGui::SameLine(0, gap);
  ImGui::BeginDisabled(name_.empty());
  done |= ImGui::Button("OK", {width, 0});
  ui.name("ok");
  ImGui::EndDisabled();
  done = done && !name_.empty();
  if (done || cancelled) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return done ? action_ + " " + lamplighter::quoted(name_) : "";
}

void centredNotice(float scale, const char* text) {
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {24 * scale, 16 * scale});
  ImGui::Begin("##notice", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::TextUnformatted(text);
  ImGui::End();
  ImGui::PopStyleVar();
}

bool ProgressBox::draw(PanelContext ui, const Progress* progress) {
  ui.prefix = "dialog/";
  if (!progress && !shown_) return false;
  const std::string id = (progress ? progress->title : std::string()) + "###progress";
  if (progress && !shown_) ImGui::OpenPopup(id.c_str());
  shown_ = progress != nullptr;
  if (!beginModal(ui, id.c_str(), 460)) return false;
  bool cancelled = false;
  if (!progress) {
    ImGui::CloseCurrentPopup();
  } else {
    ImGui::ProgressBar(progress->done, {-FLT_MIN, ui.px(10)}, "");
    note(progress->what.empty() ? " " : progress->what);
    if (progress->cancellable) {
      const float width = ui.px(96);
      ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - width);
      cancelled = ImGui::Button("Cancel", {width, 0}) || pressed(ImGuiKey_Escape);
      ui.name("cancel");
    }
  }
  ImGui::EndPopup();
  return cancelled;
}

}  // namespace lamplighter
