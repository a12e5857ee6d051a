// Registers all actions, by group; the file of each group defines them.
#pragma once

#include "editor/keys/action.h"

namespace lamplighter {

void addFileActions(ActionRegistry& registry);
void addEditActions(ActionRegistry& registry);
void addObjectActions(ActionRegistry& registry);
void addPlaceActions(ActionRegistry& registry);
void addLightActions(ActionRegistry& registry);
void addLightsActions(ActionRegistry& registry);
void addLightStateActions(ActionRegistry& registry);
void addLinkActions(ActionRegistry& registry);
void addTreeActions(ActionRegistry& registry);
void addSkyActions(ActionRegistry& registry);
void addViewActions(ActionRegistry& registry);
void addRenderActions(ActionRegistry& registry);
void addSeeingActions(ActionRegistry& registry);
void addCostActions(ActionRegistry& registry);
void addSplitActions(ActionRegistry& registry);
void addRecoveryActions(ActionRegistry& registry);
void addHistoryActions(ActionRegistry& registry);
void addPreferenceActions(ActionRegistry& registry);
void addCameraActions(ActionRegistry& registry);
void addDropActions(ActionRegistry& registry);
void addAssetActions(ActionRegistry& registry);

inline void addAllActions(ActionRegistry& registry) {
  addFileActions(registry);
  addEditActions(registry);
  addObjectActions(registry);
  addLightActions(registry);
  addPlaceActions(registry);  // after light.add, because it offers the kinds of light.add
  addLightsActions(registry);
  addLightStateActions(registry);
  addLinkActions(registry);
  addTreeActions(registry);
  addSkyActions(registry);
  addViewActions(registry);
  addRenderActions(registry);
  addSeeingActions(registry);
  addCostActions(registry);
  addSplitActions(registry);
  addRecoveryActions(registry);
  addHistoryActions(registry);
  addPreferenceActions(registry);
  addCameraActions(registry);
  addDropActions(registry);
  addAssetActions(registry);
}

}  // namespace lamplighter
