// Draws the light table. The rows and figures come from editor/lights/light_table.h.
#include "ui/panels/light_table/light_table_panel.h"

#include <algorithm>
#include <array>
#include <map>

#include <imgui.h>

#include "editor/lights/light_edits.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

struct ColumnInfo {
  LightColumn column;
  const char* name;  // name of the widget
  const char* label;
  float width;  // design pixels
  bool isNumber;
  const char* help;
};
constexpr std::array kColumns = {
    ColumnInfo{LightColumn::name, "name", "Name", 108, false, ""},
    ColumnInfo{LightColumn::kind, "kind", "Kind", 66, false, ""},
    ColumnInfo{LightColumn::on, "on", "On", 20, false, "Whether the light is switched on."},
    ColumnInfo{LightColumn::solo, "solo", "Solo", 30, false,
               "While any light is solo, only lights that are solo emit."},
    ColumnInfo{LightColumn::colour, "colour", "Colour", 46, false, ""},
    ColumnInfo{LightColumn::temperature, "temperature", "Temp.", 56, true,
               "Temperature of the black body with the nearest colour."},
    ColumnInfo{
        LightColumn::strength, "strength", "Intensity", 66, true,
        "In the unit chosen above, or in the light's own unit if it cannot be given in that one."},
    ColumnInfo{LightColumn::size, "size", "Size", 78, true, "In metres, before the scale."},
    ColumnInfo{LightColumn::group, "group", "Group", 60, false, ""},
    ColumnInfo{LightColumn::share, "share", "Share", 40, true,
               "Share of the flux of all lights that are on."},
    ColumnInfo{LightColumn::samples, "samples", "VPLs", 36, true,
               "Light samples that are shown, bounced ones included."},
    ColumnInfo{LightColumn::patches, "patches", "Patches", 52, true,
               "Patches of surface that at least one of its samples may reach."},
    ColumnInfo{LightColumn::milliseconds, "milliseconds", "ms", 44, true,
               "Estimated part of the frame time that this light costs while the picture changes, "
               "by its samples and the patches that they reach."},
    ColumnInfo{LightColumn::pending, "pending", "Pending", 52, true,
               "Samples that wait for an update of their shadow map."},
    ColumnInfo{LightColumn::age, "age", "Age", 28, true,
               "Number of frames for which the oldest of them has waited."},
};

constexpr float kLeastTableHeight = 84.0f;  // design pixels
// design pixels; largest extra width of the names in a wide window
constexpr float kMostSpare = 160.0f;

class Table {
 public:
  Table(const PanelContext& ui, LightTableState& state)
      : ui_(ui), state_(state), cells_{ui, state} {
    rows_ = ui.session.lighting().table.rows(ui.session, ui.session.lighting().unit);
    for (const LightRow& r : rows_) ++named_[r.name];
    const auto isOf = [&](const LightRow& r) { return r.source.node == state.row; };
    if (std::none_of(rows_.begin(), rows_.end(), isOf)) state.row = kNoNode;
  }

  void draw() {
    constexpr ImGuiTableFlags kFlags =
        ImGuiTableFlags_Sortable | ImGuiTableFlags_SortTristate | ImGuiTableFlags_Resizable |
        ImGuiTableFlags_Reorderable | ImGuiTableFlags_Hideable | ImGuiTableFlags_RowBg |
        ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit |
        ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_PadOuterX;
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {ui_.px(4), ui_.px(2)});
    spare_ = ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize;
    for (const ColumnInfo& c : kColumns) spare_ -= ui_.px(c.width) + 2 * ui_.px(4) + 1.0f;
    spare_ = std::clamp(spare_, 0.0f, ui_.px(kMostSpare));
    // If the bar takes many lines, the panel scrolls.
    const float height = std::max(ImGui::GetContentRegionAvail().y, ui_.px(kLeastTableHeight));
    if (ImGui::BeginTable("##table", static_cast<int>(kColumns.size()), kFlags, {0.0f, height})) {
      headers();
      sort();
      for (const LightRow& r : rows_) row(r);
      cells_.byKeyboard(rows_);
      ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    if (rows_.empty()) note("The scene has no light. Add one by the menu Light.");
  }

 private:
  void headers() {
    ImGui::TableSetupScrollFreeze(1, 1);
    for (const ColumnInfo& c : kColumns) {
      // In a wide window the name column is wider.
      const float more = c.column == LightColumn::name ? spare_ : 0.0f;
      ImGui::TableSetupColumn(c.label, ImGuiTableColumnFlags_WidthFixed, ui_.px(c.width) + more);
    }
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (size_t i = 0; i < kColumns.size(); ++i) {
      if (!ImGui::TableSetColumnIndex(static_cast<int>(i))) continue;
      heading(kColumns[i]);
    }
  }

  // Draws the label itself. ImGui would shorten it to make room for the sort arrow, and would
  // left-align it above right-aligned figures.
  void heading(const ColumnInfo& c) {
    const float room = ImGui::GetContentRegionAvail().x, left = ImGui::GetCursorScreenPos().x;
    ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(0, 0));
    ImGui::TableHeader((std::string("##") + c.name).c_str());
    ImGui::PopStyleColor();
    ui_.name(std::string("header/") + c.name);
    const std::string help = c.help;
    tooltip(ui_, help + (help.empty() ? "" : " ") + "Click to sort by this column.");
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const float width = ImGui::CalcTextSize(c.label).x;
    const float x = c.isNumber && width < room ? left + room - width : left;
    const bool isSorted = (ImGui::TableGetColumnFlags() & ImGuiTableColumnFlags_IsSorted) != 0;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText({x, low.y + ui_.px(2)}, theme::colour(isSorted ? theme::kAccent : theme::kTextDim),
                 c.label);
    if (isSorted) sortMark(list, 0.5f * (low.x + high.x), low.y, high.y);
  }

  // On the side of the largest values.
  void sortMark(ImDrawList& list, float x, float top, float bottom) const {
    const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
    if (specs == nullptr || specs->SpecsCount == 0) return;
    const bool rises = specs->Specs[0].SortDirection == ImGuiSortDirection_Ascending;
    const float edge = rises ? bottom : top, tip = edge + (rises ? -1.0f : 1.0f) * ui_.px(4);
    list.AddTriangleFilled({x - ui_.px(5), edge}, {x + ui_.px(5), edge}, {x, tip},
                           theme::colour(theme::kAccent));
  }

  void sort() {
    const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
    if (specs == nullptr || specs->SpecsCount == 0) return;
    const ImGuiTableColumnSortSpecs& by = specs->Specs[0];
    sortRows(rows_, kColumns[static_cast<size_t>(by.ColumnIndex)].column,
             by.SortDirection == ImGuiSortDirection_Ascending);
  }

  static bool isDim(const LightRow& r) { return !r.visible || !r.shines; }

  void row(const LightRow& r) {
    ImGui::PushID(static_cast<int>(r.source.node));
    ImGui::TableNextRow();
    if (isDim(r)) ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(theme::kTextDim));
    for (size_t i = 0; i < kColumns.size(); ++i) {
      if (!ImGui::TableSetColumnIndex(static_cast<int>(i))) continue;
      cell(r, kColumns[i]);
      cells_.cell(r, kColumns[i].column, widgetOf(r));
    }
    if (isDim(r)) ImGui::PopStyleColor();
    ImGui::PopID();
  }

  void cell(const LightRow& r, const ColumnInfo& c) {
    if (cells_.isEdited(r, c.column) && c.column != LightColumn::name)
      return cells_.field(r, c.column);
    switch (c.column) {
      case LightColumn::name:
        nameCell(r);
        return;
      case LightColumn::on:
        toggle(r, "on", r.state.on, [](LightState& s, bool on) { s.on = on; });
        return;
      case LightColumn::solo:
        toggle(r, "solo", r.state.solo, [](LightState& s, bool solo) { s.solo = solo; });
        return;
      case LightColumn::colour:
        swatch(ui_, r.colour, ImGui::GetContentRegionAvail().x);
        return;
      default:
        if (c.isNumber)
          rightAligned(cellText(r, c.column), isDim(r) ? theme::kTextDim : theme::kText);
        else
          ImGui::TextUnformatted(cellText(r, c.column).c_str());
    }
  }

  void nameCell(const LightRow& r) {
    constexpr ImGuiSelectableFlags kFlags =
        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap;
    const std::string name = r.name.empty() ? "(unnamed)" : r.name;
    const ImVec2 at = ImGui::GetCursorPos();
    const bool isEditedHere = cells_.isEdited(r, LightColumn::name);
    const std::string shown = isEditedHere ? "##row" : name + "##row";
    if (ImGui::Selectable(shown.c_str(), r.selected, kFlags) && state_.row != r.source.node)
      select(r.source.node);
    ui_.name(widgetOf(r));
    if (isEditedHere) {
      ImGui::SetCursorPos(at);
      cells_.field(r, LightColumn::name);
    }
    if (!r.visible) tooltip(ui_, "The light is hidden. The eye in the outliner shows it again.");
  }

  template <typename Change>
  void toggle(const LightRow& r, const char* what, bool value, Change change) {
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui_.px(1), ui_.px(0)});
    const std::string id = std::string("##") + what;
    const bool clicked = ImGui::Checkbox(id.c_str(), &value);
    ImGui::PopStyleVar();
    ui_.name(widgetOf(r) + "/" + what);
    if (!clicked) return;
    const std::string label = std::string(value ? "Switch " : "End ") + what;
    const auto apply = [&](LightState& s) { change(s, value); };
    if (r.source.node == kNoNode)
      editSkyState(ui_.session.editing(), label, apply);
    else if (r.selected)
      editLightStates(ui_.session.editing(), label, apply);
    else
      editLightStates(ui_.session.editing(), {r.source.node}, label, apply);
  }

  // As in the outliner: the name, plus the id if the name is not unique.
  std::string widgetOf(const LightRow& r) const {
    const std::string name = r.name.empty() ? "(unnamed)" : r.name;
    return named_.at(r.name) > 1 || r.name.empty() ? name + "#" + std::to_string(r.source.node)
                                                   : name;
  }

  void select(NodeId id) {
    Session& s = ui_.session;
    state_.before = s.document().selection;
    if (id == kNoNode) return s.select({});  // the inspector then shows the sky
    if (ImGui::GetIO().KeyShift) {
      s.select(rowsBetween(rows_, s.document().active(), id));
    } else if (ImGui::GetIO().KeyCtrl) {
      std::vector<NodeId> ids = s.document().selection;
      if (std::erase(ids, id) == 0) ids.push_back(id);
      s.select(std::move(ids));
    } else {
      s.select({id});
    }
  }

  const PanelContext& ui_;
  LightTableState& state_;
  LightCells cells_;
  std::vector<LightRow> rows_;
  std::map<std::string, int> named_;
  float spare_ = 0.0f;  // width beyond the needs of the columns [pixels]
};

}  // namespace

void lightTable(PanelContext ui, LightTableState& state, Requests& requests) {
  ui.prefix = "lights/";
  lightTableBar(ui, state, requests);
  Table(ui, state).draw();
}

}  // namespace lamplighter
