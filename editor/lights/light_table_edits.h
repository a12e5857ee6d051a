// Edits cells of the light table in place. The typed text applies to all selected lights.
#pragma once

#include <string>

#include "editor/edits/editing.h"
#include "editor/lights/light_table.h"

namespace lamplighter {

// Whether the cells of the column accept text.
bool isTyped(LightColumn column);
// "strength" etc., for actions and widget names.
const char* columnName(LightColumn column);
// Applies the cell text to the selected lights, as one undo step: "lamp", "800 lm", "2700 K", "1.2
// x 0.6", "kitchen". A strength without a unit is in `shown`. If several lights are selected, their
// names get numbers. Throws InputError if the text is not a valid value.
void editLightTableCells(Editing& editing, LightColumn column, const std::string& text,
                         LightUnit shown);

}  // namespace lamplighter
