// The parts of compare() (scene_changes.h), for callers that know which items of two scenes differ.
// None of them considers which lights are on (light_state.h) or what they leave out
// (light_linking.h).
#pragma once

#include "renderer/scene/scene_changes.h"

namespace lamplighter {

bool sameStructure(const Node& before, const Node& after);
void addMaterialChange(SceneChanges& changes, int index, const Material& before,
                       const Material& after);
// For two nodes with the same structure.
void addNodeChange(SceneChanges& changes, const Node& before, const Node& after);
// Adds the nodes below those that moved. Sorts the lists of nodes.
void addMovedChildren(SceneChanges& changes, const Scene& after);

}  // namespace lamplighter
