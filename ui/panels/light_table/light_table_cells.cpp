#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <imgui.h>
// For the rectangles of cells, which imgui.h of 1.86 does not declare.
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include "editor/lights/light_edits.h"
#include "editor/lights/light_table_edits.h"
#include "renderer/base/error.h"
#include "ui/panels/light_table/light_table_panel.h"

namespace lamplighter {
namespace {

std::string countOf(int value) { return value == 0 ? "\u2013" : grouped(value); }

}  // namespace

std::string cellText(const LightRow& r, LightColumn column) {
  const LightFigures& f = r.figures;
  char text[64] = "";
  switch (column) {
    case LightColumn::kind:
      return kindLabel(r.source.measure.kind);
    case LightColumn::temperature:
      return r.kelvin ? grouped(std::lround(*r.kelvin)) + " K" : "\u2013";
    case LightColumn::strength:
      return short3(r.strength) + " " + unitSymbol(r.unit);
    case LightColumn::size:
      if (r.size.x <= 0.0f) return "\u2013";
      return r.size.x == r.size.y ? short3(static_cast<double>(r.size.x))
                                  : short3(static_cast<double>(r.size.x)) + " \u00d7 " +
                                        short3(static_cast<double>(r.size.y));
    case LightColumn::group:
      return r.state.group;
    case LightColumn::share:
      if (f.share <= 0.0) return "\u2013";
      if (f.share < 0.0005) return "< 0.1%";
      std::snprintf(text, sizeof text, f.share < 0.1 ? "%.1f%%" : "%.0f%%", 100.0 * f.share);
      return text;
    case LightColumn::samples:
      return countOf(f.samples);
    case LightColumn::patches:
      return countOf(f.patches);
    case LightColumn::milliseconds:
      if (f.milliseconds <= 0.0) return "\u2013";
      std::snprintf(text, sizeof text, "%.2f", f.milliseconds);
      return text;
    case LightColumn::pending:
      return countOf(f.mapsPending);
    case LightColumn::age:
      return countOf(f.age);
    default:
      return r.name;
  }
}

void LightCells::cell(const LightRow& row, LightColumn column, const std::string& widget) const {
  if (row.source.node == kNoNode || (!isTyped(column) && column != LightColumn::colour)) return;
  const ImRect cell =
      ImGui::TableGetCellBgRect(ImGui::GetCurrentTable(), ImGui::TableGetColumnIndex());
  const ImRect clip(ImGui::GetWindowDrawList()->GetClipRectMin(),
                    ImGui::GetWindowDrawList()->GetClipRectMax());
  ImRect visible = cell;
  visible.ClipWithFull(clip);
  ui.widgets.add(ui.prefix + widget + "/" + columnName(column),
                 {{cell.Min.x, cell.Min.y}, {cell.Max.x, cell.Max.y}},
                 {{visible.Min.x, visible.Min.y}, {visible.Max.x, visible.Max.y}});
  if (!ImGui::IsMouseDoubleClicked(0) || !ImGui::IsWindowHovered() ||
      !visible.Contains(ImGui::GetIO().MousePos) || isEdited(row, column))
    return;
  // The first click of the double click has reduced the selection to this row.
  std::vector<NodeId>& before = state.before;
  if (std::find(before.begin(), before.end(), row.source.node) != before.end()) {
    std::erase(before, row.source.node);
    before.push_back(row.source.node);
    ui.session.select(before);
  }
  begin(row, column);
}

void LightCells::begin(const LightRow& row, LightColumn column) const {
  state.row = row.source.node;
  state.column = column;
  const bool isNone = column == LightColumn::temperature && !row.kelvin;
  state.text = isNone ? "" : cellText(row, column);
  state.begins = true;
}

void LightCells::byKeyboard(const std::vector<LightRow>& rows) const {
  const NodeId active = ui.session.document().active();
  if (state.row != kNoNode || ImGui::GetIO().WantTextInput || !ImGui::IsWindowFocused() ||
      !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false))
    return;
  for (const LightRow& row : rows)
    if (row.source.node == active && active != kNoNode) begin(row, LightColumn::name);
}

void LightCells::field(const LightRow& row, LightColumn column) const {
  if (column == LightColumn::colour) return colourPopup(row);
  const bool begins = std::exchange(state.begins, false);
  if (begins) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(1), 0});
  const bool entered =
      ImGui::InputText("##cell", &state.text,
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  ImGui::PopStyleVar();
  ui.name("cell");
  const bool takes = entered || ImGui::IsItemDeactivatedAfterEdit();
  if (!takes && !ImGui::IsItemDeactivated()) return;
  state.row = kNoNode;
  if (!takes || state.text == cellText(row, column)) return;
  try {
    editLightTableCells(ui.session.editing(), column, state.text, ui.session.lighting().unit);
  } catch (const InputError& e) {
    ui.session.setStatus(e.what());
  }
}

void LightCells::colourPopup(const LightRow& row) const {
  swatch(ui, row.colour, ImGui::GetContentRegionAvail().x);
  if (std::exchange(state.begins, false)) ImGui::OpenPopup("##colour");
  if (!ImGui::BeginPopup("##colour")) {
    state.row = kNoNode;
    return;
  }
  const float most = std::max({row.colour.r, row.colour.g, row.colour.b, 1e-6f});
  vec3 shown = linearToSrgb(glm::clamp(row.colour / most, 0.0f, 1.0f));
  ImGui::SetNextItemWidth(ui.px(200));
  const bool changed = ImGui::ColorPicker3(
      "##picker", &shown.x, ImGuiColorEditFlags_PickerHueWheel | ImGuiColorEditFlags_NoSidePreview);
  ui.name("colour_picker");
  trackEdit(ui, "Change colour of lights");
  if (changed && luminance(srgbToLinear(shown)) > 0.0f)
    colourLights(ui.session.editing(), srgbToLinear(shown));
  ImGui::EndPopup();
}

}  // namespace lamplighter
