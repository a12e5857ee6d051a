// What a session keeps about working with lights that is no part of the document.
#pragma once

#include "editor/lights/light_table.h"

namespace lamplighter {

struct LightingState {
  LightUnit unit = LightUnit::lumens;  // in which strength is shown and typed
  bool showsTable = false;
  LightTable table;
  // A lamp at the eye for dark scenes, in no document and no file [cd]; 0: off.
  float workLight = 0.0f;
};

}  // namespace lamplighter
