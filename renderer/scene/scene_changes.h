// What changed between two states of a scene, typed, so that each part of the renderer refreshes
// what it must and no more. Made by comparing (never by hand), so undo refreshes what do did.
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace lamplighter {

struct SceneChanges {
  bool everything = false;  // another scene altogether
  bool structure = false;   // nodes or meshes came or went, or hid or showed
  bool sky = false;
  std::vector<NodeId> moved;   // world transform changed (children of a moved node included)
  std::vector<NodeId> lights;  // light parameters (not the place) changed
  std::vector<int> materials;  // material parameters changed

  bool none() const {
    return !everything && !structure && !sky && moved.empty() && lights.empty() &&
           materials.empty();
  }
  void merge(const SceneChanges& other);
  static SceneChanges all() {
    SceneChanges c;
    c.everything = true;
    return c;
  }
};

// Finds what differs. Names do not count: nothing is rendered anew for them.
SceneChanges compare(const Scene& before, const Scene& after);

}  // namespace lamplighter
