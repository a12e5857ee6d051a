// An edit in progress: the only access to a mutable document. If it is not committed, its
// destructor restores the previous state, also after an exception.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "editor/edits/document_change.h"

namespace lamplighter {

class Editing;

// Each accessor records the value before the change, so that it can be undone; call it for every
// change instead of keeping its result. References are valid until nodes are added or removed.
class Transaction {
 public:
  Transaction() = default;  // not open
  Transaction(Transaction&& other) noexcept
      : editing_(std::exchange(other.editing_, nullptr)), id_(other.id_) {}
  Transaction& operator=(Transaction&& other) noexcept;
  ~Transaction();

  Node& node(NodeId id);  // throws InputError if it does not exist
  Material& material(int index);
  Sky& sky();  // the sky becomes the user's and is no longer the default of a scene without lights
  LightState& skyLight();
  std::vector<LightGroup>& lightGroups();
  std::vector<CameraBookmark>& bookmarks();
  RenderSettings& render();

  // Replaces existing nodes. Ignores others.
  void setNodes(std::vector<Node> nodes);
  // Adds nodes at the end, parents before children, with ids of Editing::newNodeId().
  void addNodes(std::vector<Node> nodes);
  // Removes nodes and all their descendants.
  void removeNodes(const std::vector<NodeId>& ids);
  // Moves nodes and all their descendants to the end of the list.
  void moveToEnd(const std::vector<NodeId>& ids);
  // Adds assets at the ends of their lists.
  void add(std::shared_ptr<const Mesh> mesh);
  void add(Material material);
  void add(Texture texture);

  // False if it was committed or cancelled, or ended in another way, for example by an undo.
  bool isOpen() const;
  void commit();  // if it is open; if that throws, it can still be cancelled
  void cancel();  // if it is open: undoes its changes

 private:
  friend class Editing;
  Transaction(Editing& editing, uint64_t id) : editing_(&editing), id_(id) {}
  Document& document();
  // Records the current value, if it is not recorded yet, and returns it for editing.
  template <typename T>
  T& recorded(Change<T> DocumentChange::*part, T& value);
  // The same for an item of a list. The index after the last one adds an item.
  template <typename T>
  T& recorded(ItemChanges<T> DocumentChange::*part, std::vector<T>& list, size_t index);

  Editing* editing_ = nullptr;
  uint64_t id_ = 0;
};

}  // namespace lamplighter
