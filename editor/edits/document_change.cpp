#include "editor/edits/document_change.h"

#include <unordered_map>

namespace lamplighter {

namespace {

// Calls f(part of a, the same part of b, its value in the document) for each single value.
template <typename A, typename B, typename D, typename F>
void forEachValue(A& a, B& b, D& document, F f) {
  f(a.sky, b.sky, document.scene.sky);
  f(a.skyIsDefault, b.skyIsDefault, document.scene.skyIsDefault);
  f(a.skyLight, b.skyLight, document.scene.skyLight);
  f(a.lightGroups, b.lightGroups, document.scene.lightGroups);
  f(a.bookmarks, b.bookmarks, document.scene.bookmarks);
  f(a.render, b.render, document.render);
}

// The same for each list of items with an index.
template <typename A, typename B, typename D, typename F>
void forEachList(A& a, B& b, D& document, F f) {
  f(a.meshes, b.meshes, document.scene.meshes);
  f(a.materials, b.materials, document.scene.materials);
  f(a.textures, b.textures, document.scene.textures);
}

std::vector<NodeId> orderOf(const Scene& scene) {
  std::vector<NodeId> out;
  for (const Node& n : scene.nodes) out.push_back(n.id);
  return out;
}

template <typename T>
const std::optional<T>& sideOf(const Change<T>& change, bool after) {
  return after ? change.after : change.before;
}

// Finds many nodes in a scene whose list may have any order.
std::unordered_map<NodeId, const Node*> nodesById(const Scene& scene) {
  std::unordered_map<NodeId, const Node*> out;
  for (const Node& n : scene.nodes) out[n.id] = &n;
  return out;
}

void putNodes(const DocumentChange& change, Scene& scene, bool after) {
  const auto& order = sideOf(change.order, after);
  if (!order) {
    for (const auto& [id, node] : change.nodes) *scene.find(id) = *sideOf(node, after);
    return;
  }
  const auto now = nodesById(scene);
  std::vector<Node> ordered;
  ordered.reserve(order->size());
  for (const NodeId id : *order) {
    const auto changed = change.nodes.find(id);
    ordered.push_back(changed == change.nodes.end() ? *now.at(id)
                                                    : *sideOf(changed->second, after));
  }
  scene.nodes = std::move(ordered);
}

void put(const DocumentChange& change, Document& document, bool after) {
  putNodes(change, document.scene, after);
  forEachList(change, change, document, [&](const auto& items, const auto&, auto& list) {
    for (const auto& [index, item] : items) {
      const auto& value = sideOf(item, after);
      if (!value) {
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(index), list.end());
        break;
      }
      if (index < list.size())
        list[index] = *value;
      else
        list.push_back(*value);
    }
  });
  forEachValue(change, change, document, [&](const auto& value, const auto&, auto& now) {
    if (const auto& side = sideOf(value, after)) now = *side;
  });
}

}  // namespace

void DocumentChange::recordNode(const Scene& scene, NodeId id) {
  const auto [node, isNew] = nodes.try_emplace(id);
  if (!isNew) return;
  if (const Node* now = scene.find(id)) node->second.before = *now;
}

void DocumentChange::recordOrder(const Scene& scene) {
  if (!order.before) order.before = orderOf(scene);
}

void DocumentChange::recordAll(const Document& document, const DocumentChange& other) {
  for (const auto& [id, node] : other.nodes) recordNode(document.scene, id);
  if (other.order.before) recordOrder(document.scene);
  forEachList(*this, other, document, [](auto& mine, const auto& theirs, const auto& list) {
    for (const auto& [index, item] : theirs) recordItem(mine, list, index);
  });
  forEachValue(*this, other, document, [](auto& mine, const auto& theirs, const auto& now) {
    if (theirs.before) record(mine, now);
  });
}

void DocumentChange::complete(const Document& document) {
  const auto isSame = [](const auto& item) { return item.second.before == item.second.after; };
  if (!order.before) {
    for (auto& [id, node] : nodes) node.after = *document.scene.find(id);
  } else {
    const auto now = nodesById(document.scene);
    for (auto& [id, node] : nodes) {
      node.after.reset();
      if (const auto it = now.find(id); it != now.end()) node.after = *it->second;
    }
  }
  std::erase_if(nodes, isSame);
  if (order.before) order.after = orderOf(document.scene);
  if (order.before == order.after) order = {};
  forEachList(*this, *this, document, [&](auto& items, auto&, const auto& list) {
    for (auto& [index, item] : items) {
      item.after.reset();
      if (index < list.size()) item.after = list[index];
    }
    std::erase_if(items, isSame);
  });
  forEachValue(*this, *this, document, [](auto& value, auto&, const auto& now) {
    if (value.before) value.after = now;
    if (value.before == value.after) value = {};
  });
}

bool DocumentChange::empty() const {
  return nodes.empty() && !order.before && meshes.empty() && materials.empty() &&
         textures.empty() && !sky.before && !skyIsDefault.before && !skyLight.before &&
         !lightGroups.before && !bookmarks.before && !render.before;
}

void DocumentChange::apply(Document& document) const { put(*this, document, true); }
void DocumentChange::revert(Document& document) const { put(*this, document, false); }

}  // namespace lamplighter
