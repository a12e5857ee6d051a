// The light table below the view: shows all lights and edits the selected ones.
#pragma once

#include <string>
#include <vector>

#include "editor/lights/light_table.h"
#include "ui/panels/panels.h"

namespace lamplighter {

struct LightTableState {
  int property = 0;   // index into lightProperties()
  std::string value;  // typed text
  std::string group;  // typed text
  // The light whose cell is being edited; kNoNode: none.
  NodeId row = kNoNode;
  LightColumn column = LightColumn::name;
  std::string text;
  bool begins = false;  // the field takes the keyboard focus in this frame
  // The selection before the last click. A double click edits all of these lights.
  std::vector<NodeId> before;
};
void lightTable(PanelContext ui, LightTableState& state, Requests& requests);
// The upper part: operations on all selected lights.
void lightTableBar(PanelContext ui, LightTableState& state, Requests& requests);

// The text of a cell.
std::string cellText(const LightRow& row, LightColumn column);

// light_table_cells.cpp: edits cells in place while the table is drawn.
struct LightCells {
  const PanelContext& ui;
  LightTableState& state;

  // Call after a cell was drawn. Gives the cell a name. A double click on it starts to edit this
  // cell in all selected rows.
  void cell(const LightRow& row, LightColumn column, const std::string& widget) const;
  // Enter on the selected row edits its name.
  void byKeyboard(const std::vector<LightRow>& rows) const;
  bool isEdited(const LightRow& row, LightColumn column) const {
    return state.row != kNoNode && state.row == row.source.node && state.column == column;
  }
  // Draws a text field instead of the cell. Enter or a lost focus applies the text, Escape cancels.
  void field(const LightRow& row, LightColumn column) const;

 private:
  void begin(const LightRow& row, LightColumn column) const;
  void colourPopup(const LightRow& row) const;
};

// A filled square of a linear colour, scaled so that the brightest channel is 1. Its height is one
// line.
void swatch(const PanelContext& ui, const vec3& linear, float width);

}  // namespace lamplighter
