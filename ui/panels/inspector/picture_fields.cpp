// The picture of a rectangle or disk light: its file and a preview.
#include <algorithm>

#include <imgui.h>

#include "renderer/scene/light_picture.h"
#include "ui/panels/panels.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

constexpr int kPreviewColumns = 64, kMostPreviewRows = 64;

// Draws the picture as at most 64 × 64 coloured squares, because panels draw no textures.
void preview(const PanelContext& ui, const LightPicture& picture, bool isDisk) {
  const Image8& image = *picture.image;
  const float width = std::min(ImGui::GetContentRegionAvail().x, ui.px(200));
  const float aspect = static_cast<float>(image.height) / static_cast<float>(image.width);
  const float height = std::clamp(width * aspect, ui.px(20), ui.px(160));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy({width, height});
  ui.name("picture/preview");
  tooltip(ui, std::to_string(image.width) + " \u00d7 " + std::to_string(image.height) + " pixels");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const int columns = std::min(kPreviewColumns, image.width);
  const int rows = std::clamp(static_cast<int>(static_cast<float>(columns) * height / width), 1,
                              std::min(kMostPreviewRows, image.height));
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const float u = (static_cast<float>(column) + 0.5f) / static_cast<float>(columns);
      const float v = (static_cast<float>(row) + 0.5f) / static_cast<float>(rows);
      if (isDisk && (u - 0.5f) * (u - 0.5f) + (v - 0.5f) * (v - 0.5f) > 0.25f) continue;
      const uint8_t* p = image.at(static_cast<int>(u * static_cast<float>(image.width)),
                                  static_cast<int>(v * static_cast<float>(image.height)));
      const auto edge = [](float from, float size, int i, int n) {
        return std::round(from + size * static_cast<float>(i) / static_cast<float>(n));
      };
      draw.AddRectFilled(
          {edge(at.x, width, column, columns), edge(at.y, height, row, rows)},
          {edge(at.x, width, column + 1, columns), edge(at.y, height, row + 1, rows)},
          IM_COL32(p[0], p[1], p[2], 255));
    }
  }
}

}  // namespace

void pictureFields(const PanelContext& ui, const Node& node, Requests& requests) {
  const auto picture = node.area->picture;
  labelledRow(
      ui, "Picture",
      "A PNG or JPEG picture whose pixels scale the radiance: for a screen, a window or a sign.");
  if (!fileButtons(ui, "picture", "light.picture", picture ? &picture->file : nullptr, requests))
    return;
  if (shownPicture(*node.area) == nullptr) {
    note("Only rectangles and disks can show a picture.");
    return;
  }
  labelledRow(ui, "");
  preview(ui, *picture, node.area->shape == AreaShape::disk);
  const vec3 mean = meanFactor(*node.area);
  note("Leaves " + short3(100.0 * static_cast<double>(luminance(mean))) +
       "% of the radiance; the units above take that into account.");
}

}  // namespace lamplighter
