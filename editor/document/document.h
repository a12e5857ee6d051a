// The edited document: scene, selection, settings, and the file that it was loaded from. Only
// editor/edits changes it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <unordered_set>
#include <vector>

#include "renderer/base/parameters.h"
#include "renderer/scene/scene.h"

namespace lamplighter {

// Settings of the renderer: part of the document, so that they can be undone, but their changes
// need not be saved.
struct RenderSettings {
  std::string method = "many_lights";
  Settings values;
  float exposureEv = 0.0f;  // picture = radiance × 2^EV, then the tone mapper
  bool operator==(const RenderSettings&) const = default;
};

struct Document {
  Scene scene;
  RenderSettings render;
  std::vector<NodeId> selection;  // the last one is the active one
  std::filesystem::path path;     // empty: never saved

  bool isSelected(NodeId id) const;
  // For callers that check many nodes.
  std::unordered_set<NodeId> selected() const { return {selection.begin(), selection.end()}; }
  NodeId active() const { return selection.empty() ? kNoNode : selection.back(); }
};

// A hash of everything in the document that a user can change (scene and render settings, not the
// selection), equal on every machine; checkpoints of recordings compare it.
uint64_t documentHash(const Document& document);
// The part of the scene in this hash: the content of a saved file.
uint64_t sceneHash(const Scene& scene);

}  // namespace lamplighter
