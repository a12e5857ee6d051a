#include <algorithm>

#include "ui/panels/panels.h"

namespace lamplighter {
namespace {

bool beginModal(const PanelContext& ui, const char* title, float width) {
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(ui.px(width), 0.96f * ImGui::GetMainViewport()->Size.x), 0});
  return beginBorderedModal(title, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings);
}

bool pressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false); }

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
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text_.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, ui.px(6)});
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
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(
      ("Save the changes to " + (file.empty() ? "the scene" : file) + "? They are lost otherwise.")
          .c_str());
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, ui.px(6)});
  Answer answer = Answer::none;
  const float width = ui.px(96);
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 3 * width - 2 * ui.px(7));
  if (ImGui::Button("Cancel", {width, 0}) || pressed(ImGuiKey_Escape)) answer = Answer::cancel;
  ui.name("cancel");
  ImGui::SameLine(0, ui.px(7));
  if (ImGui::Button("Don't save", {width, 0})) answer = Answer::discard;
  ui.name("discard");
  ImGui::SameLine(0, ui.px(7));
  if (ImGui::Button("Save", {width, 0})) answer = Answer::save;
  ui.name("save");
  if (answer != Answer::none) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return answer;
}

OverwriteQuestion::Answer OverwriteQuestion::draw(PanelContext ui) {
  constexpr const char* kTitle = "Changed on disk";
  ui.prefix = "dialog/";
  if (!changed_.empty() && !ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
  if (!beginModal(ui, kTitle, 460)) return Answer::none;
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted((changed_ + " was changed or removed by another program since it was "
                                     "opened. Overwriting it loses those changes.")
                             .c_str());
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, ui.px(6)});
  Answer answer = Answer::none;
  const float width = ui.px(96);
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 3 * width - 2 * ui.px(7));
  if (ImGui::Button("Cancel", {width, 0}) || pressed(ImGuiKey_Escape)) answer = Answer::cancel;
  ui.name("cancel");
  ImGui::SameLine(0, ui.px(7));
  if (ImGui::Button("Overwrite", {width, 0})) answer = Answer::overwrite;
  ui.name("overwrite");
  ImGui::SameLine(0, ui.px(7));
  if (ImGui::Button("Save as\u2026", {width, 0})) answer = Answer::saveAs;
  ui.name("save_as");
  if (answer != Answer::none) {
    changed_.clear();
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
  return answer;
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
