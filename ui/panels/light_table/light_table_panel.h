// The light table, below the view: all lights, and edits of those that are selected.
#pragma once

#include <string>
#include <vector>

#include "editor/lights/light_table.h"
#include "ui/panels/panels.h"

namespace lamplighter {

struct LightTableState {
  int property = 0;   // index into lightProperties()
  std::string value;  // being typed
  std::string group;  // likewise
  // The cell that is being edited, of the row of a light; kNoNode: none.
  NodeId row = kNoNode;
  LightColumn column = LightColumn::name;
  std::string text;
  bool begins = false;  // give it the keyboard
  // As the selection was before the last click: a double click edits all of it.
  std::vector<NodeId> before;
};
void lightTable(PanelContext ui, LightTableState& state, Requests& requests);
// Its upper part: what is done to all selected lights.
void lightTableBar(PanelContext ui, LightTableState& state, Requests& requests);

// What a cell of the table says.
std::string cellText(const LightRow& row, LightColumn column);

// light_table_cells.cpp: editing cells in place, within the table as it is drawn.
struct LightCells {
  const PanelContext& ui;
  LightTableState& state;

  // The cell that was just drawn: names it, and a double click on it begins to edit it in all
  // selected rows.
  void cell(const LightRow& row, LightColumn column, const std::string& widget) const;
  // Enter on the row that is selected edits its name.
  void byKeyboard(const std::vector<LightRow>& rows) const;
  bool isEdited(const LightRow& row, LightColumn column) const {
    return state.row != kNoNode && state.row == row.source.node && state.column == column;
  }
  // Instead of the cell. Enter and leaving it take what is typed, Escape does not.
  void field(const LightRow& row, LightColumn column) const;

 private:
  void begin(const LightRow& row, LightColumn column) const;
  void colourPopup(const LightRow& row) const;
};

// A filled square of a linear colour, brightest channel 1, as wide as asked and as high as a line.
void swatch(const PanelContext& ui, const vec3& linear, float width);

}  // namespace lamplighter
