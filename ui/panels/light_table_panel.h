// The light table, below the view: all lights, and edits of those that are selected.
#pragma once

#include <string>

#include "ui/panels/panels.h"

namespace lamplighter {

struct LightTableState {
  int property = 0;   // index into lightProperties()
  std::string value;  // being typed
  std::string group;  // likewise
};
void lightTable(PanelContext ui, LightTableState& state, Requests& requests);
// Its upper part: what is done to all selected lights.
void lightTableBar(PanelContext ui, LightTableState& state, Requests& requests);

// A filled square of a linear colour, brightest channel 1, as wide as asked and as high as a line.
void swatch(const PanelContext& ui, const vec3& linear, float width);

}  // namespace lamplighter
