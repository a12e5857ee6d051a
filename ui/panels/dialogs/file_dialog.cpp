#include "ui/panels/dialogs/file_dialog.h"

#include <algorithm>
#include <cstdlib>

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include "editor/actions/arguments.h"
#include "editor/session/user_state.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/keyboard.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostPlaces = 9;  // one key for each

}  // namespace

void FileDialog::open(const std::string& action, const ActionAsk& asks, const fs::path& start) {
  action_ = action;
  asks_ = asks;
  opening_ = true;
  std::error_code error;
  const fs::path folder = fs::absolute(choosesFolder() ? start : start.parent_path(), error);
  go(fs::is_directory(folder, error) ? folder : fs::current_path(error));
  file_ = writes() ? start.filename().string() : "";
}

void FileDialog::go(const fs::path& folder) {
  folder_ = folder.lexically_normal();
  if (!folder_.has_filename() && folder_.has_relative_path()) folder_ = folder_.parent_path();
  entries_ = listFolder(folder_, asks_.extensions, error_);
  filters_ = false;
  chosen_ = -1;
  if (!writes()) file_.clear();
  ImGui::ClearActiveID();  // otherwise ImGui would restore the old text of the line
  takesFocus_ = true;
}

// Favourites, the folders of recent files, and home.
std::vector<fs::path> FileDialog::places(const Session& session) const {
  const Preferences& p = session.home().preferences;
  std::vector<fs::path> all = p.favouriteFolders;
  const char* home = std::getenv("HOME");
  std::vector<fs::path> more = p.recentFolders();
  if (home != nullptr && fs::path(home).is_absolute()) more.emplace_back(home);
  for (const fs::path& folder : more)
    if (std::find(all.begin(), all.end(), folder) == all.end()) all.push_back(folder);
  if (all.size() > kMostPlaces) all.resize(kMostPlaces);
  return all;
}

void FileDialog::drawFolder(const PanelContext& ui) {
  if (ImGui::Button("Up")) go(folder_.parent_path());
  ui.name("up");
  tooltip(ui, "The folder above (Alt+Up, or Backspace in an empty line)");
  ImGui::SameLine();
  Preferences& p = ui.session.home().preferences;
  const bool isFavourite = std::find(p.favouriteFolders.begin(), p.favouriteFolders.end(),
                                     folder_) != p.favouriteFolders.end();
  if (ImGui::Button(isFavourite ? "Unpin" : "Pin")) p.toggleFavourite(folder_);
  ui.name("favourite");
  tooltip(ui, "Adds this folder to the list on the left, or removes it");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  const std::string folder = folder_.string();
  ImGui::TextUnformatted(endOf(folder, ImGui::GetContentRegionAvail().x).c_str());
  tooltip(ui, folder);
}

void FileDialog::drawPlaces(const PanelContext& ui) {
  const std::vector<fs::path> all = places(ui.session);
  const auto& favourites = ui.session.home().preferences.favouriteFolders;
  for (size_t i = 0; i < all.size(); ++i) {
    const std::string name =
        all[i].filename().empty() ? all[i].string() : all[i].filename().string();
    const bool isFavourite =
        std::find(favourites.begin(), favourites.end(), all[i]) != favourites.end();
    const std::string label = (isFavourite ? "\u2022 " : "") + name + "##" + std::to_string(i);
    if (ImGui::Selectable(label.c_str(), all[i] == folder_, ImGuiSelectableFlags_DontClosePopups))
      go(all[i]);
    ui.name("place " + std::to_string(i + 1));
    tooltip(ui, all[i].string() + " (Ctrl+" + std::to_string(i + 1) + ")");
  }
}

// True if a file was double-clicked.
bool FileDialog::drawEntries(const PanelContext& ui, const std::vector<FileEntry>& shown) {
  for (size_t i = 0; i < shown.size(); ++i) {
    const FileEntry entry = shown[i];
    const std::string label =
        withIcon(entry.folder ? icon::kFolder : icon::kFile, entry.name) + "##" + entry.name;
    const bool isChosen = static_cast<int>(i) == chosen_;
    const bool clicked = ImGui::Selectable(
        label.c_str(), isChosen || (file_ == entry.name && !entry.folder),
        ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups);
    ui.name(entry.name);
    if (isChosen && scrolls_) ImGui::SetScrollHereY();
    if (!clicked) continue;
    if (entry.folder) {
      go(folder_ / entry.name);
      break;  // the list of entries has changed
    }
    file_ = entry.name;
    filters_ = false;
    chosen_ = -1;
    return ImGui::IsMouseDoubleClicked(0);
  }
  scrolls_ = false;
  if (!error_.empty()) note(error_);
  if (error_.empty() && shown.empty())
    note(filters_ ? "No file with this name." : "No files of this kind here.");
  return false;
}

// True if Enter was pressed.
bool FileDialog::drawLine(const PanelContext& ui) {
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (takesFocus_) ImGui::SetKeyboardFocusHere();
  takesFocus_ = false;
  const std::string before = file_;
  const std::string hint =
      "A name, a part of one, or a path (" + endingsText(asks_.extensions) + ")";
  const bool entered = ImGui::InputTextWithHint("##file", hint.c_str(), &file_,
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  ui.name("file");
  if (file_ != before) {
    filters_ = !writes() && file_.find('/') == std::string::npos && !file_.empty();
    chosen_ = -1;
  }
  return entered;
}

// True if the text of the line or the chosen file is confirmed.
bool FileDialog::pressKeys(const PanelContext& ui, const std::vector<FileEntry>& shown,
                           bool entered) {
  const int last = static_cast<int>(shown.size()) - 1;
  const ImGuiIO& io = ImGui::GetIO();
  const bool up = pressed(ImGuiKey_UpArrow, true), down = pressed(ImGuiKey_DownArrow, true);
  if ((up && io.KeyAlt) || (file_.empty() && pressed(ImGuiKey_Backspace))) {
    go(folder_.parent_path());
    return false;
  }
  if (io.KeyCtrl) {
    const std::vector<fs::path> all = places(ui.session);
    for (size_t i = 0; i < all.size(); ++i) {
      const auto key = static_cast<int>(Key::n1) + static_cast<int>(i);
      if (!ImGui::IsKeyPressed(key, false)) continue;
      go(all[i]);
      return false;
    }
  }
  if ((up || down) && last >= 0) {
    chosen_ = std::clamp(chosen_ + (down ? 1 : -1), 0, last);
    scrolls_ = true;
  }
  if (!entered) return false;
  takesFocus_ = true;
  // If the typed text matches only one entry, choose it.
  if (chosen_ < 0 && filters_ && last == 0) chosen_ = 0;
  if (chosen_ >= 0 && chosen_ <= last) {
    const FileEntry entry = shown[static_cast<size_t>(chosen_)];
    if (entry.folder) {
      go(folder_ / entry.name);
      return false;
    }
    file_ = entry.name;
    return true;
  }
  std::error_code error;
  const fs::path typed = folder_ / file_;  // an absolute path replaces the folder
  if (!file_.empty() && fs::is_directory(typed, error)) {
    file_.clear();
    go(typed);
    return false;
  }
  return !file_.empty() || choosesFolder();
}

std::string FileDialog::answer() const {
  fs::path path = file_.empty() ? folder_ : folder_ / file_;
  if (writes() && !hasExtension(path, asks_.extensions)) path += asks_.extensions.front();
  return action_ + " " + quoted(path.lexically_normal().string());
}

std::string FileDialog::draw(PanelContext ui) {
  cancelled_ = false;
  ui.prefix = "dialog/";
  const std::string title = asks_.title + "###file";
  if (opening_) ImGui::OpenPopup(title.c_str());
  opening_ = false;
  const ImVec2 window = ImGui::GetMainViewport()->Size;
  ImGui::SetNextWindowSize(
      {std::min(ui.px(720), 0.96f * window.x), std::min(ui.px(460), 0.92f * window.y)});
  const ImVec2 middle = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(middle, ImGuiCond_Always, {0.5f, 0.5f});
  // Arrow keys choose an entry, independent of the focus.
  if (!beginBorderedModal(title.c_str(), ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                             ImGuiWindowFlags_NoNavInputs))
    return "";

  drawFolder(ui);
  const std::vector<FileEntry> shown = filters_ ? filtered(entries_, file_) : entries_;
  const float below = 2 * ImGui::GetFrameHeightWithSpacing() + ui.px(4);
  const float side = std::min(ui.px(150), 0.3f * ImGui::GetContentRegionAvail().x);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::colour(theme::kPanel));
  ImGui::BeginChild("places", {side, -below}, true, ImGuiWindowFlags_NoNavInputs);
  drawPlaces(ui);
  ImGui::EndChild();
  ImGui::SameLine(0, ui.px(6));
  ImGui::BeginChild("entries", {0, -below}, true, ImGuiWindowFlags_NoNavInputs);
  bool done = drawEntries(ui, shown);
  ImGui::EndChild();
  ImGui::PopStyleColor();

  const bool entered = drawLine(ui);
  if (pressKeys(ui, shown, entered)) done = true;
  const float width = ui.px(96);
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 2 * width - ui.px(7));
  const bool refused = ImGui::Button("Cancel", {width, 0}) || pressed(ImGuiKey_Escape);
  ui.name("cancel");
  ImGui::SameLine(0, ui.px(7));
  ImGui::BeginDisabled(file_.empty() && !choosesFolder());
  if (ImGui::Button(writes() ? "Save" : choosesFolder() ? "Choose" : "Open", {width, 0}))
    done = true;
  ui.name("ok");
  ImGui::EndDisabled();
  done = done && (!file_.empty() || choosesFolder());
  cancelled_ = refused && !done;
  if (done || refused) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return done ? answer() : "";
}

}  // namespace lamplighter
