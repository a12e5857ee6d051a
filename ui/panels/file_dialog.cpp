#include <algorithm>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/icons.h"
#include "ui/panels/panels.h"
#include "ui/theme.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

std::string endingOf(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool isScene(const fs::path& path) {
  const std::string ending = endingOf(path);
  return ending == ".gltf" || ending == ".glb";
}

bool isPicture(const fs::path& path) {
  static constexpr const char* kEndings[] = {".exr", ".hdr", ".png", ".jpg", ".jpeg", ".webp"};
  return std::find(std::begin(kEndings), std::end(kEndings), endingOf(path)) != std::end(kEndings);
}

bool isTimeline(const fs::path& path) {
  return endingOf(path) == ".json" || endingOf(path) == ".csv";
}

bool fits(FileDialog::Kind kind, const fs::path& path) {
  if (kind == FileDialog::Kind::picture || kind == FileDialog::Kind::lightPicture)
    return isPicture(path);
  if (kind == FileDialog::Kind::profile) return endingOf(path) == ".ies";
  return kind == FileDialog::Kind::timeline ? isTimeline(path) : isScene(path);
}

}  // namespace

void FileDialog::open(Kind kind, const fs::path& start) {
  kind_ = kind;
  opening_ = true;
  error_.clear();
  std::error_code error;
  folder_ = fs::absolute(start.empty() ? fs::current_path(error) : start.parent_path(), error);
  if (!fs::is_directory(folder_, error)) folder_ = fs::current_path(error);
  file_ = kind == Kind::save ? start.filename().string() : "";
  if (kind == Kind::save && file_.empty()) file_ = "untitled.gltf";
  if (kind == Kind::timeline) file_ = "timeline.json";
  list();
}

void FileDialog::list() {
  entries_.clear();
  std::error_code error;
  for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    const std::string name = it->path().filename().string();
    if (name.empty() || name.front() == '.') continue;
    if (it->is_directory(ignored))
      entries_.push_back({name, true});
    else if (fits(kind_, it->path()))
      entries_.push_back({name, false});
  }
  error_ = error ? folder_.string() + ": " + error.message() : "";
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.folder != b.folder ? a.folder : a.name < b.name;
  });
}

std::optional<fs::path> FileDialog::draw(PanelContext ui) {
  ui.prefix = "dialog/";
  const char* title = kind_ == Kind::open           ? "Open a scene###file"
                      : kind_ == Kind::picture      ? "Open a picture of the sky###file"
                      : kind_ == Kind::profile      ? "Open a profile of a light###file"
                      : kind_ == Kind::lightPicture ? "Open a picture of a light###file"
                      : kind_ == Kind::timeline     ? "Export the timeline###file"
                                                    : "Save as###file";
  if (opening_) ImGui::OpenPopup(title);
  opening_ = false;
  const ImVec2 window = ImGui::GetMainViewport()->Size;
  ImGui::SetNextWindowSize(
      {std::min(ui.px(620), 0.96f * window.x), std::min(ui.px(440), 0.92f * window.y)});
  const ImVec2 middle = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(middle, ImGuiCond_Always, {0.5f, 0.5f});
  std::optional<fs::path> chosen;
  if (!beginBorderedModal(title, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove))
    return chosen;

  if (ImGui::Button("Up")) {
    folder_ = folder_.parent_path();
    list();
  }
  ui.name("up");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  const std::string folder = folder_.string();
  ImGui::TextUnformatted(endOf(folder, ImGui::GetContentRegionAvail().x).c_str());
  tooltip(ui, folder);
  const float below = 2 * ImGui::GetFrameHeightWithSpacing() + ui.px(4);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::colour(theme::kPanel));
  ImGui::BeginChild("entries", {0, -below}, true);
  bool done = false;
  for (const Entry& entry : entries_) {
    const std::string label =
        withIcon(entry.folder ? icon::kFolder : icon::kFile, entry.name) + "##" + entry.name;
    const bool clicked = ImGui::Selectable(
        label.c_str(), file_ == entry.name,
        ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups);
    ui.name(entry.name);
    if (!clicked) continue;
    if (entry.folder) {
      folder_ /= entry.name;
      list();
      break;  // the entries are others now
    }
    file_ = entry.name;
    done = ImGui::IsMouseDoubleClicked(0);
  }
  if (!error_.empty()) note(error_);
  ImGui::EndChild();
  ImGui::PopStyleColor();

  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::InputTextWithHint("##file", "File name, or a whole path", &file_,
                               ImGuiInputTextFlags_EnterReturnsTrue))
    done = true;
  ui.name("file");
  const float width = ui.px(96);
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 2 * width - ui.px(7));
  if (ImGui::Button("Cancel", {width, 0}) ||
      ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)))
    ImGui::CloseCurrentPopup();
  ui.name("cancel");
  ImGui::SameLine(0, ui.px(7));
  ImGui::BeginDisabled(file_.empty());
  const bool writes = kind_ == Kind::save || kind_ == Kind::timeline;
  if (ImGui::Button(writes ? "Save" : "Open", {width, 0})) done = true;
  ui.name("ok");
  ImGui::EndDisabled();
  if (done && !file_.empty()) {
    fs::path path = folder_ / file_;  // an absolute name replaces the folder
    if (kind_ == Kind::save && !isScene(path)) path += ".gltf";
    if (kind_ == Kind::timeline && !isTimeline(path)) path += ".json";
    chosen = path.lexically_normal();
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
  return chosen;
}

}  // namespace lamplighter
