// The differences between two states of a scene by type, so that each part of the renderer updates
// only what is necessary. They depend on the two states alone: undo updates the same as the edit.
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace lamplighter {

struct SceneChanges {
  bool everything = false;  // a different scene
  bool structure = false;   // nodes or meshes were added, removed, hidden or shown
  bool sky = false;
  std::vector<NodeId> moved;   // world transform changed (includes children of a moved node)
  std::vector<NodeId> lights;  // light parameters (not the position) changed
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

// Compares two scenes. Names are ignored, because they do not affect rendering.
SceneChanges compare(const Scene& before, const Scene& after);

}  // namespace lamplighter
