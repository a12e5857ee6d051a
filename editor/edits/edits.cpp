#include "editor/edits/edits.h"

#include <string>
#include <unordered_map>
#include <unordered_set>

#include "renderer/base/error.h"

namespace lamplighter {

std::vector<bool> withDescendants(const Scene& scene, const std::vector<NodeId>& ids) {
  std::unordered_set<NodeId> taken(ids.begin(), ids.end());
  std::vector<bool> in(scene.nodes.size());
  for (size_t i = 0; i < scene.nodes.size(); ++i) {  // parents come first
    const Node& n = scene.nodes[i];
    in[i] = taken.contains(n.id) || (n.parent != kNoNode && taken.contains(n.parent));
    if (in[i]) taken.insert(n.id);
  }
  return in;
}

Copies copyNodes(Editing& editing, const std::vector<NodeId>& ids) {
  const Scene& scene = editing.document().scene;
  const std::vector<NodeId> roots = topmost(scene, ids);
  const std::vector<bool> copied = withDescendants(scene, roots);
  const std::unordered_set<NodeId> isRoot(roots.begin(), roots.end());
  Copies out;
  std::unordered_map<NodeId, NodeId> newId;
  for (size_t i = 0; i < copied.size(); ++i) {
    if (!copied[i]) continue;
    Node n = scene.nodes[i];
    const NodeId copy = newId[n.id] = editing.newNodeId();
    if (isRoot.contains(n.id)) out.roots.push_back(copy);
    n.id = copy;
    if (const auto parent = newId.find(n.parent); parent != newId.end()) n.parent = parent->second;
    out.nodes.push_back(std::move(n));
  }
  return out;
}

std::vector<NodeId> topmost(const Scene& scene, const std::vector<NodeId>& ids) {
  const std::unordered_set<NodeId> given(ids.begin(), ids.end());
  std::unordered_set<NodeId> below;  // one of them
  std::vector<NodeId> out;
  for (const Node& n : scene.nodes) {  // parents come first
    const bool isBelow =
        n.parent != kNoNode && (given.contains(n.parent) || below.contains(n.parent));
    if (isBelow) below.insert(n.id);
    if (given.contains(n.id) && !isBelow) out.push_back(n.id);
  }
  return out;
}

void requireRoomFor(const Scene& scene, size_t more) {
  constexpr size_t kMostNodes = 20000;
  if (more <= kMostNodes && scene.nodes.size() + more <= kMostNodes) return;
  throw InputError(std::to_string(more) + " more objects", "are too many for this level",
                   "copying works up to " + std::to_string(kMostNodes) + " objects");
}

void setNodes(Editing& editing, const std::string& label, std::vector<Node> nodes) {
  Transaction edit = editing.begin(label);
  edit.setNodes(std::move(nodes));
  edit.commit();
}

void addNodes(Editing& editing, const std::string& label, std::vector<Node> nodes) {
  Transaction edit = editing.begin(label);
  edit.addNodes(std::move(nodes));
  edit.commit();
}

}  // namespace lamplighter
