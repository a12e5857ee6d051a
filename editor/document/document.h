// What is being edited: scene, selection, settings, and the file it came from. It is changed through
// editor/edits only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <unordered_set>
#include <vector>

#include "renderer/base/parameters.h"
#include "renderer/scene/scene.h"

namespace lamplighter {

// How the picture is made; part of the document so that undo covers it, but no reason to save.
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
  // For those who ask of many.
  std::unordered_set<NodeId> selected() const { return {selection.begin(), selection.end()}; }
  NodeId active() const { return selection.empty() ? kNoNode : selection.back(); }
};

// A hash of everything in the document that a user can change (scene and render settings, not the
// selection), equal on every machine: what recordings' checkpoints compare.
uint64_t documentHash(const Document& document);
// The scene's part of it: what a file would hold.
uint64_t sceneHash(const Scene& scene);

}  // namespace lamplighter
