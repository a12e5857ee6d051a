#include "editor/edits/transaction.h"

#include <iterator>

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

void Transaction::commit() {
  if (editing_ != nullptr) std::exchange(editing_, nullptr)->commit(id_);
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

template <typename Record>
Document& Transaction::recorded(Record record) {
  Document& document = editing_->document_;
  editing_->recordInAll([&](DocumentChange& change) { record(change, document); });
  return document;
}

Node& Transaction::node(NodeId id) {
  Node* node = editing_->document_.scene.find(id);
  if (node == nullptr) throw InputError("object", "it is not there any more", "select another");
  recorded([&](DocumentChange& c, const Document& d) { c.recordNode(d.scene, id); });
  return *node;
}

Material& Transaction::material(int index) {
  const auto i = static_cast<size_t>(index);
  return recorded([&](DocumentChange& c, const Document& d) {
           c.recordItem(c.materials, d.scene.materials, i);
         })
      .scene.materials.at(i);
}

Sky& Transaction::sky() {
  Scene& scene = recorded([](DocumentChange& c, const Document& d) {
                   c.record(c.sky, d.scene.sky);
                   c.record(c.skyIsDefault, d.scene.skyIsDefault);
                 }).scene;
  scene.skyIsDefault = false;
  return scene.sky;
}

LightState& Transaction::skyLight() {
  return recorded(
             [](DocumentChange& c, const Document& d) { c.record(c.skyLight, d.scene.skyLight); })
      .scene.skyLight;
}

std::vector<LightGroup>& Transaction::lightGroups() {
  return recorded([](DocumentChange& c, const Document& d) {
           c.record(c.lightGroups, d.scene.lightGroups);
         })
      .scene.lightGroups;
}

std::vector<CameraBookmark>& Transaction::bookmarks() {
  return recorded(
             [](DocumentChange& c, const Document& d) { c.record(c.bookmarks, d.scene.bookmarks); })
      .scene.bookmarks;
}

RenderSettings& Transaction::render() {
  return recorded([](DocumentChange& c, const Document& d) { c.record(c.render, d.render); })
      .render;
}

void Transaction::setNodes(std::vector<Node> nodes) {
  for (Node& n : nodes) {
    if (editing_->document_.scene.find(n.id) != nullptr) node(n.id) = std::move(n);
  }
}

void Transaction::addNodes(std::vector<Node> nodes) {
  Scene& scene = recorded([&](DocumentChange& c, const Document& d) {
                   c.recordOrder(d.scene);
                   for (const Node& n : nodes) c.nodes.try_emplace(n.id);
                 }).scene;
  std::move(nodes.begin(), nodes.end(), std::back_inserter(scene.nodes));
}

void Transaction::removeNodes(const std::vector<NodeId>& ids) {
  const std::vector<bool> isRemoved = withDescendants(editing_->document_.scene, ids);
  Scene& scene = recorded([&](DocumentChange& c, const Document& d) {
                   c.recordOrder(d.scene);
                   for (size_t i = 0; i < isRemoved.size(); ++i)
                     if (isRemoved[i]) c.recordNode(d.scene, d.scene.nodes[i].id);
                 }).scene;
  takeOut(scene.nodes, isRemoved);
}

void Transaction::moveToEnd(const std::vector<NodeId>& ids) {
  Scene& scene =
      recorded([](DocumentChange& c, const Document& d) { c.recordOrder(d.scene); }).scene;
  std::vector<Node> moved = takeOut(scene.nodes, withDescendants(scene, ids));
  std::move(moved.begin(), moved.end(), std::back_inserter(scene.nodes));
}

void Transaction::addMesh(std::shared_ptr<const Mesh> mesh) {
  auto& meshes = recorded([](DocumentChange& c, const Document& d) {
                   c.recordItem(c.meshes, d.scene.meshes, d.scene.meshes.size());
                 }).scene.meshes;
  meshes.push_back(std::move(mesh));
}

void Transaction::addMaterial(Material material) {
  auto& materials = recorded([](DocumentChange& c, const Document& d) {
                      c.recordItem(c.materials, d.scene.materials, d.scene.materials.size());
                    }).scene.materials;
  materials.push_back(std::move(material));
}

void Transaction::addTexture(Texture texture) {
  auto& textures = recorded([](DocumentChange& c, const Document& d) {
                     c.recordItem(c.textures, d.scene.textures, d.scene.textures.size());
                   }).scene.textures;
  textures.push_back(std::move(texture));
}

}  // namespace lamplighter
