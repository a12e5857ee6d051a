#include "ui/panels/asset_panel.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/actions/arguments.h"
#include "editor/session/user_state.h"
#include "ui/panels/panels.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/thumbnails.h"

namespace lamplighter {
namespace {

std::string placingOf(const AssetFile& file) {
  return callText({"asset.place", file.path.string()});
}

// The file name without its folder, shortened to the available width.
void caption(const std::string& name, const ImVec2& low, float width) {
  const auto widthOf = [](const std::string& t) { return ImGui::CalcTextSize(t.c_str()).x; };
  std::string text = name.substr(name.rfind('/') + 1), whole = text;
  while (widthOf(text) > width && !whole.empty()) {
    // Do not cut a UTF-8 character: all its bytes except the first are 10xxxxxx.
    unsigned char last = 0;
    do {
      last = static_cast<unsigned char>(whole.back());
      whole.pop_back();
    } while (!whole.empty() && (last & 0xc0) == 0x80);
    text = whole + "\u2026";
  }
  const float indent = std::max(0.0f, 0.5f * (width - ImGui::CalcTextSize(text.c_str()).x));
  ImGui::GetWindowDrawList()->AddText({std::round(low.x + indent), low.y},
                                      theme::colour(theme::kText), text.c_str());
}

void drawThumbnail(const Thumbnails::Thumbnail& thumbnail, const ImVec2& low, float side) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (thumbnail.texture != 0) {
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<intptr_t>(thumbnail.texture)), low,
                  {low.x + side, low.y + side});
    return;
  }
  const char* sign = thumbnail.problem.empty() ? icon::kUpdating : icon::kWarning;
  if (!theme::hasIcons()) return;
  const ImVec2 size = ImGui::CalcTextSize(sign);
  list.AddText({low.x + 0.5f * (side - size.x), low.y + 0.5f * (side - size.y)},
               theme::colour(theme::kTextDim), sign);
}

void bar(const PanelContext& ui, AssetPanelState& state, Requests& requests) {
  const UserState& home = ui.session.home();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Assets");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(std::min(ui.px(220), 0.35f * ImGui::GetContentRegionAvail().x));
  ImGui::InputTextWithHint("##search", "Search", &state.search);
  ui.name("search");
  ImGui::SameLine();
  if (ImGui::Button(withIcon(icon::kFolder, "Folder\u2026").c_str()))
    requests.actions.emplace_back("asset.folder");
  ui.name("folder");
  tooltip(ui, "Choose the folder whose .gltf and .glb files are shown");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  const std::filesystem::path& folder = home.preferences.assetFolder;
  ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(theme::kTextDim));
  // The whole path is usually too long for the bar; the tooltip shows it.
  const std::string end = (folder.parent_path().filename() / folder.filename()).string();
  ImGui::TextUnformatted(endOf(end, ImGui::GetContentRegionAvail().x).c_str());
  ImGui::PopStyleColor();
  tooltip(ui, folder.string());
}

void grid(const PanelContext& ui, const std::vector<AssetFile>& files, Thumbnails* thumbnails,
          Requests& requests) {
  const int pixels = ui.session.home().preferences.settings().thumbnailSize;
  const float side = std::round(ui.px(static_cast<float>(pixels))), gap = ui.px(6);
  const float high = side + ImGui::GetTextLineHeight() + ui.px(4);
  const float room = ImGui::GetContentRegionAvail().x;
  const int columns = std::max(1, static_cast<int>((room + gap) / (side + gap)));
  for (size_t i = 0; i < files.size(); ++i) {
    const AssetFile& file = files[i];
    if (i % static_cast<size_t>(columns) != 0) ImGui::SameLine(0, gap);
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const std::string placing = placingOf(file);
    const bool isPlaced = ui.session.placed() == placing;
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable("##asset", isPlaced, 0, {side, high}))
      requests.actions.push_back("place.start " + placing);
    ImGui::PopID();
    ui.name(file.name);
    // Items outside the visible area are not rendered until they are scrolled into view.
    if (ImGui::IsItemVisible()) {
      static const Thumbnails::Thumbnail kNone;
      const int wanted = std::clamp(static_cast<int>(side), 32, 512);
      const auto& thumbnail = thumbnails ? thumbnails->get(file.path, wanted) : kNone;
      drawThumbnail(thumbnail, low, side);
      caption(file.name, {low.x, low.y + side + ui.px(2)}, side);
      tooltip(ui,
              thumbnail.problem.empty()
                  ? file.name +
                        ": click it, then click a surface to place it. Hold Shift to place several."
                  : thumbnail.problem);
    }
  }
}

}  // namespace

void assetPanel(PanelContext ui, AssetPanelState& state, Thumbnails* thumbnails,
                Requests& requests) {
  ui.prefix = "assets/";
  const UserState& home = ui.session.home();
  const std::filesystem::path& folder = home.preferences.assetFolder;
  if (folder != home.assetsListed && !state.listed)
    requests.actions.push_back("asset.folder " + quoted(folder.string()));
  state.listed = true;  // list only once, so that a missing folder is reported once
  bar(ui, state, requests);
  ImGui::BeginChild("grid", {0, 0}, false, ImGuiWindowFlags_NavFlattened);
  const std::vector<AssetFile> files = matchingAssets(home.assetFiles, state.search);
  if (folder.empty())
    note("Choose a folder of glTF files; each is placed by a click on it and one into the view.");
  else if (files.empty())
    note(state.search.empty() ? "There is no .gltf or .glb file in this folder."
                              : "No file with this name.");
  grid(ui, files, thumbnails, requests);
  ImGui::EndChild();
}

}  // namespace lamplighter
