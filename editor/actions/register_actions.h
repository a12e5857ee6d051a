// All actions, by group; each group's file says what its actions do.
#pragma once

#include "editor/actions/action.h"

namespace lamplighter {

void addFileActions(ActionRegistry& registry);
void addEditActions(ActionRegistry& registry);
void addObjectActions(ActionRegistry& registry);
void addLightActions(ActionRegistry& registry);
void addSkyActions(ActionRegistry& registry);
void addViewActions(ActionRegistry& registry);
void addRenderActions(ActionRegistry& registry);
void addCostActions(ActionRegistry& registry);
void addSplitActions(ActionRegistry& registry);

inline void addAllActions(ActionRegistry& registry) {
  addFileActions(registry);
  addEditActions(registry);
  addObjectActions(registry);
  addLightActions(registry);
  addSkyActions(registry);
  addViewActions(registry);
  addRenderActions(registry);
  addCostActions(registry);
  addSplitActions(registry);
}

}  // namespace lamplighter
