// A part of a scene with its meshes, materials and textures: the content of the clipboard, which
// can be pasted into another level. Meshes and pixels are shared.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "editor/edits/editing.h"

namespace lamplighter {

struct ClipboardFragment {
  std::vector<Node> nodes;  // parents before children; topmost nodes keep the id of their parent
  // World transforms of the topmost nodes, for levels without their parents.
  std::map<NodeId, Transform> places;
  // By their indices in the original scene.
  std::map<int, std::shared_ptr<const Mesh>> meshes;
  std::map<int, Material> materials;
  std::map<int, Texture> textures;

  bool empty() const { return nodes.empty(); }
};

// The nodes with all their descendants.
ClipboardFragment clip(const Scene& scene, const std::vector<NodeId>& ids);

// The content that a paste adds: nodes with new ids, and assets that the scene does not have yet.
struct PastedNodes {
  std::vector<Node> nodes;
  std::vector<NodeId> roots;
  std::vector<std::shared_ptr<const Mesh>> meshes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
};
// In the level of the original nodes they keep their parents. In another level they keep their
// world transform.
PastedNodes pasteInto(Editing& editing, const ClipboardFragment& fragment, bool isSameLevel);
void add(Transaction& edit, PastedNodes pasted);

}  // namespace lamplighter
