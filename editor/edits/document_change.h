// What an edit changed in a document: the values before and after of everything that differs. It is
// one step of the history, one line of the journal, and the source of a frame's SceneChanges.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "editor/document/document.h"
#include "renderer/scene/scene_changes.h"

namespace lamplighter {

template <typename T>
struct Change {
  std::optional<T> before, after;
};

// Changes of a list by index. Items are only added and removed at its end. An item that one of the
// states does not have has no value there.
template <typename T>
using ItemChanges = std::map<size_t, Change<T>>;

// A change is recorded in two stages. First, record…() keeps the current value of each part that is
// about to be edited, once. Then complete() adds the values after, and drops the parts that are
// equal again. So its cost depends on the number of edited parts, not on the duration of the edit.
struct DocumentChange {
  std::map<NodeId, Change<Node>> nodes;  // a new or removed node has one value only
  Change<std::vector<NodeId>> order;     // of Scene::nodes, if nodes were added, removed or moved
  ItemChanges<std::shared_ptr<const Mesh>> meshes;
  ItemChanges<Material> materials;
  ItemChanges<Texture> textures;
  // No values: not changed.
  Change<Sky> sky;
  Change<bool> skyIsDefault;
  Change<LightState> skyLight;
  Change<std::vector<LightGroup>> lightGroups;
  Change<std::vector<CameraBookmark>> bookmarks;
  Change<RenderSettings> render;

  void recordNode(const Scene& scene, NodeId id);
  void recordOrder(const Scene& scene);
  template <typename T>
  static void record(Change<T>& change, const T& now) {
    if (!change.before) change.before = now;
  }
  template <typename T>
  static void recordItem(ItemChanges<T>& changes, const std::vector<T>& list, size_t index) {
    const auto [item, isNew] = changes.try_emplace(index);
    if (isNew && index < list.size()) item->second.before = list[index];
  }
  // Records all parts that `other` changes.
  void recordAll(const Document& document, const DocumentChange& other);
  void complete(const Document& document);

  bool empty() const;
  void apply(Document& document) const;   // of the state before
  void revert(Document& document) const;  // of the state after
  // Approximate memory use. Meshes and pixels that were added or removed count, although the
  // document may share them: after an undo, the change may be their only owner.
  size_t bytes() const;
};

// The same as compare() of the scenes before and after a complete change.
SceneChanges sceneChanges(const DocumentChange& change, const Scene& after);

}  // namespace lamplighter
