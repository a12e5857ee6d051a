// Cells of the light table that are edited in place: what is typed, for all selected lights.
#pragma once

#include <string>

#include "editor/edits/editing.h"
#include "editor/lights/light_table.h"

namespace lamplighter {

// Whether the column's cells can be typed in.
bool isTyped(LightColumn column);
// "strength" and so on, in actions and names of widgets.
const char* columnName(LightColumn column);
// The selected lights with the text for the cell, one step: "lamp", "800 lm", "2700 K", "1.2 x
// 0.6", "kitchen". A strength without a unit is in `shown`. Where many are selected names are
// numbered. Throws InputError for what is no such value.
void editLightTableCells(const Editing& editing, LightColumn column, const std::string& text,
                         LightUnit shown);

}  // namespace lamplighter
