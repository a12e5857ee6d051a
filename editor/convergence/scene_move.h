// An edit that copies the transforms of objects and the settings of lights from another state of a
// level.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "editor/edits/editing.h"

namespace lamplighter {

// Nodes and materials of both scenes correspond if they have the same name; of several with one
// name, the first corresponds to the first, and so on.
struct SceneMove {
  size_t common = 0;        // nodes of the scene that have a counterpart
  std::vector<Node> nodes;  // nodes with a changed transform or changed light values
  std::vector<std::pair<int, vec3>> glows;  // materials with a changed emission [W/(m² sr)]
  std::optional<Sky> sky;                   // the new sky, if it changed

  bool none() const { return nodes.empty() && glows.empty() && !sky; }
};

// The changes of transforms and lights that turn `from` into `to`. Objects that only one of the
// scenes has, and all other properties, are ignored.
SceneMove moveTo(const Scene& from, const Scene& to);

// One step of the history, or joins the open one. `move` belongs to the scene of the document.
void applyMove(Editing& editing, const SceneMove& move);

}  // namespace lamplighter
