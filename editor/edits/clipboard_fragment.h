// A part of a scene by itself, with what it is made of: what the clipboard holds, so that it can be
// pasted into another level. Meshes and pixels stay shared.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "editor/document/document.h"
#include "editor/edits/command.h"

namespace lamplighter {

struct ClipboardFragment {
  std::vector<Node> nodes;  // parents before children; those on top keep the id of their parent
  // Where those on top are in the world, for levels where their parent is not.
  std::map<NodeId, Transform> places;
  // By the indices that they have in the scene it was taken from.
  std::map<int, std::shared_ptr<const Mesh>> meshes;
  std::map<int, Material> materials;
  std::map<int, Texture> textures;

  bool empty() const { return nodes.empty(); }
};

// The nodes with all that hangs below them.
ClipboardFragment clip(const Scene& scene, const std::vector<NodeId>& ids);

// Meshes, materials and textures at the ends of the scene's lists.
class AddAssets final : public Command {
 public:
  std::string label() const override { return "Add assets"; }
  void apply(Document& document) override;
  void revert(Document& document) override;
  bool absorb(const Command&) override { return false; }
  bool changesNothing() const override {
    return meshes.empty() && materials.empty() && textures.empty();
  }
  size_t bytes() const override;

  std::vector<std::shared_ptr<const Mesh>> meshes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
};

// What a paste adds: nodes with new ids taken from Scene::nextId, and of assets those that the
// scene does not have yet.
struct PastedNodes {
  std::vector<Node> nodes;
  std::vector<NodeId> roots;
  std::unique_ptr<AddAssets> assets;
};
// Nodes stay below their parents in the level that they come from, and come to stand on their own
// at the same place in the world elsewhere.
PastedNodes pasteInto(Scene& scene, const ClipboardFragment& fragment, bool isSameLevel);

}  // namespace lamplighter
