#include "editor/edits/transaction.h"

#include <iterator>
#include <new>

#include "editor/edits/editing.h"
#include "editor/edits/edits.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

// Removes the nodes with a flag from the list.
std::vector<Node> takeOut(std::vector<Node>& nodes, const std::vector<bool>& flags) {
  std::vector<Node> taken, others;
  for (size_t i = 0; i < nodes.size(); ++i)
    (flags[i] ? taken : others).push_back(std::move(nodes[i]));
  nodes = std::move(others);
  return taken;
}

}  // namespace

bool Transaction::isOpen() const { return editing_ != nullptr && editing_->isOpen(id_); }

Transaction::~Transaction() {
  try {
    cancel();
  } catch (const std::bad_alloc&) {
    // The edit stays open: Editing::cancel() undoes it when there is memory again.
  }
}

void Transaction::commit() {
  if (editing_ != nullptr) editing_->commit(id_);
  editing_ = nullptr;
}

void Transaction::cancel() {
  if (editing_ != nullptr) std::exchange(editing_, nullptr)->cancel(id_);
}

Transaction& Transaction::operator=(Transaction&& other) noexcept {
  cancel();
  editing_ = std::exchange(other.editing_, nullptr);
  id_ = other.id_;
  return *this;
}

Document& Transaction::document() { return editing_->document_; }

template <typename T>
T& Transaction::recorded(Change<T> DocumentChange::*part, T& value) {
  editing_->recordInAll([&](DocumentChange& c) { DocumentChange::record(c.*part, value); });
  return value;
}

template <typename T>
T& Transaction::recorded(ItemChanges<T> DocumentChange::*part, std::vector<T>& list, size_t index) {
  editing_->recordInAll(
      [&](DocumentChange& c) { DocumentChange::recordItem(c.*part, list, index); });
  if (index == list.size()) list.emplace_back();
  return list.at(index);
}

Node& Transaction::node(NodeId id) {
  Scene& scene = document().scene;
  Node* node = scene.find(id);
  if (node == nullptr) throw InputError("object", "it no longer exists", "select another");
  editing_->recordInAll([&](DocumentChange& c) { c.recordNode(scene, id); });
  return *node;
}

Material& Transaction::material(int index) {
  return recorded(&DocumentChange::materials, document().scene.materials,
                  static_cast<size_t>(index));
}

Sky& Transaction::sky() {
  recorded(&DocumentChange::skyIsDefault, document().scene.skyIsDefault) = false;
  return recorded(&DocumentChange::sky, document().scene.sky);
}

LightState& Transaction::skyLight() {
  return recorded(&DocumentChange::skyLight, document().scene.skyLight);
}

std::vector<LightGroup>& Transaction::lightGroups() {
  return recorded(&DocumentChange::lightGroups, document().scene.lightGroups);
}

std::vector<CameraBookmark>& Transaction::bookmarks() {
  return recorded(&DocumentChange::bookmarks, document().scene.bookmarks);
}

RenderSettings& Transaction::render() {
  return recorded(&DocumentChange::render, document().render);
}

void Transaction::setNodes(std::vector<Node> nodes) {
  for (Node& n : nodes) {
    if (document().scene.find(n.id) != nullptr) node(n.id) = std::move(n);
  }
}

void Transaction::addNodes(std::vector<Node> nodes) {
  Scene& scene = document().scene;
  editing_->recordInAll([&](DocumentChange& c) {
    c.recordOrder(scene);
    for (const Node& n : nodes) c.recordNode(scene, n.id);
  });
  std::move(nodes.begin(), nodes.end(), std::back_inserter(scene.nodes));
}

void Transaction::removeNodes(const std::vector<NodeId>& ids) {
  Scene& scene = document().scene;
  const std::vector<bool> isRemoved = withDescendants(scene, ids);
  editing_->recordInAll([&](DocumentChange& c) {
    c.recordOrder(scene);
    for (size_t i = 0; i < isRemoved.size(); ++i)
      if (isRemoved[i]) c.recordNode(scene, scene.nodes[i].id);
  });
  takeOut(scene.nodes, isRemoved);
}

void Transaction::moveToEnd(const std::vector<NodeId>& ids) {
  Scene& scene = document().scene;
  editing_->recordInAll([&](DocumentChange& c) { c.recordOrder(scene); });
  std::vector<Node> moved = takeOut(scene.nodes, withDescendants(scene, ids));
  std::move(moved.begin(), moved.end(), std::back_inserter(scene.nodes));
}

void Transaction::add(std::shared_ptr<const Mesh> mesh) {
  auto& meshes = document().scene.meshes;
  recorded(&DocumentChange::meshes, meshes, meshes.size()) = std::move(mesh);
}

void Transaction::add(Material material) {
  auto& materials = document().scene.materials;
  recorded(&DocumentChange::materials, materials, materials.size()) = std::move(material);
}

void Transaction::add(Texture texture) {
  auto& textures = document().scene.textures;
  recorded(&DocumentChange::textures, textures, textures.size()) = std::move(texture);
}

}  // namespace lamplighter
