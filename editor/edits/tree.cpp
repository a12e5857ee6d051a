#include "editor/edits/tree.h"

#include "editor/edits/edits.h"
#include "editor/edits/placement.h"
#include "renderer/base/error.h"

namespace lamplighter {

bool isLocked(const Scene& scene, NodeId id) {
  for (const Node* n = scene.find(id); n != nullptr; n = scene.find(n->parent))
    if (n->locked) return true;
  return false;
}

bool isWithin(const Scene& scene, NodeId id, NodeId above) {
  for (const Node* n = scene.find(id); n != nullptr; n = scene.find(n->parent))
    if (n->id == above) return true;
  return false;
}

void reparent(Editing& editing, const std::vector<NodeId>& ids, NodeId parent) {
  const Scene& scene = editing.document().scene;
  const Node* above = scene.find(parent);
  if (above == nullptr && parent != kNoNode)
    throw InputError("object.reparent", "the parent no longer exists", "choose another");
  const mat4 parentWorld = above == nullptr ? mat4(1.0f) : worldMatrix(scene, parent);
  if (!hasVolume(parentWorld))
    throw InputError(above->name, "has a scale of 0, so it cannot be a parent",
                     "give it a scale other than 0");
  std::vector<Node> moved;
  std::vector<NodeId> movedIds;
  for (const NodeId id : topmost(scene, ids)) {
    if (parent != kNoNode && isWithin(scene, parent, id))
      throw InputError(scene.find(id)->name, "cannot be its own descendant",
                       "choose another parent");
    Node n = *scene.find(id);
    if (n.parent == parent) continue;
    n.parent = parent;
    n.local = decompose(glm::inverse(parentWorld) * worldMatrix(scene, id));
    moved.push_back(std::move(n));
    movedIds.push_back(id);
  }
  if (moved.empty()) return;
  Transaction edit = editing.begin(moved.size() == 1 ? "Move " + moved[0].name + " in the tree"
                                                     : "Move in the tree");
  edit.moveToEnd(movedIds);  // where the parent comes before them
  edit.setNodes(std::move(moved));
  edit.commit();
}

void setLocked(Editing& editing, const std::vector<NodeId>& ids, bool locked) {
  std::vector<Node> nodes;
  for (const NodeId id : ids) {
    const Node* n = editing.document().scene.find(id);
    if (n == nullptr || n->locked == locked) continue;
    nodes.push_back(*n);
    nodes.back().locked = locked;
  }
  if (nodes.empty()) return;
  const std::string what = nodes.size() == 1 ? nodes[0].name : "objects";
  setNodes(editing, (locked ? "Lock " : "Unlock ") + what, std::move(nodes));
}

}  // namespace lamplighter
