#include "editor/edits/tree.h"

#include <algorithm>
#include <unordered_map>

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

Reparent::Reparent(const Document& document, const std::vector<NodeId>& ids, NodeId parent) {
  const Scene& scene = document.scene;
  const Node* above = scene.find(parent);
  if (above == nullptr && parent != kNoNode)
    throw InputError("object.reparent", "the parent is not there any more", "take another");
  const mat4 parentWorld = above == nullptr ? mat4(1.0f) : worldMatrix(scene, parent);
  if (!hasVolume(parentWorld))
    throw InputError(above->name, "has no volume, so that nothing below it has a place",
                     "give it a scale other than 0");
  const std::vector<NodeId> moved = topmost(scene, ids);
  for (const NodeId id : moved) {
    if (parent != kNoNode && isWithin(scene, parent, id))
      throw InputError(scene.find(id)->name, "cannot hang below itself", "take another parent");
    Node n = *scene.find(id);
    if (n.parent == parent) continue;
    before_.push_back(n);
    n.parent = parent;
    n.local = decompose(glm::inverse(parentWorld) * worldMatrix(scene, id));
    after_.push_back(std::move(n));
  }
  label_ = after_.size() == 1 ? "Move " + after_[0].name + " in the tree" : "Move in the tree";
  // The moved ones and all below them go to the end: nothing that stays hangs below them.
  std::vector<NodeId> goes;
  for (const Node& n : scene.nodes) {
    orderBefore_.push_back(n.id);
    const bool isMoved = std::any_of(after_.begin(), after_.end(),
                                     [&](const Node& m) { return isWithin(scene, n.id, m.id); });
    (isMoved ? goes : orderAfter_).push_back(n.id);
  }
  orderAfter_.insert(orderAfter_.end(), goes.begin(), goes.end());
}

size_t Reparent::bytes() const {
  return sizeof *this + bytesOf(before_) + bytesOf(after_) +
         sizeof(NodeId) * (orderBefore_.size() + orderAfter_.size());
}

void Reparent::put(Document& document, const std::vector<Node>& nodes,
                   const std::vector<NodeId>& order) {
  std::vector<Node>& all = document.scene.nodes;
  for (const Node& node : nodes) {
    if (Node* now = document.scene.find(node.id)) *now = node;
  }
  std::unordered_map<NodeId, size_t> place;
  for (size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  std::stable_sort(all.begin(), all.end(),
                   [&](const Node& a, const Node& b) { return place.at(a.id) < place.at(b.id); });
}

void reparent(const Editing& editing, const std::vector<NodeId>& ids, NodeId parent) {
  auto command = std::make_unique<Reparent>(editing.document, ids, parent);
  if (!command->changesNothing()) editing.history.run(std::move(command));
}

void setLocked(const Editing& editing, const std::vector<NodeId>& ids, bool locked) {
  std::vector<Node> nodes;
  for (const NodeId id : ids) {
    const Node* n = editing.document.scene.find(id);
    if (n == nullptr || n->locked == locked) continue;
    nodes.push_back(*n);
    nodes.back().locked = locked;
  }
  if (nodes.empty()) return;
  const std::string what = nodes.size() == 1 ? nodes[0].name : "objects";
  editing.history.run(std::make_unique<EditNodes>((locked ? "Lock " : "Unlock ") + what,
                                                  editing.document, std::move(nodes)));
}

}  // namespace lamplighter
