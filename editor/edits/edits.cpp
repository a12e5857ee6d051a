#include "editor/edits/edits.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "renderer/base/error.h"
#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_picture.h"

namespace lamplighter {

namespace {

size_t bytesOf(const Node& n) {
  return sizeof n + n.name.size() + n.light.group.size() + sizeof(NodeId) * n.light.leftOut.size() +
         (n.punctual && n.punctual->profile ? n.punctual->profile->text.size() : 0) +
         (n.area && n.area->picture
              ? n.area->picture->bytes->size() + n.area->picture->image->pixels.size()
              : 0);
}

}  // namespace

size_t bytesOf(const std::vector<Node>& nodes) {
  size_t sum = 0;
  for (const Node& n : nodes) sum += bytesOf(n);
  return sum;
}

namespace {

size_t bytesOf(const RenderSettings& r) {
  constexpr size_t kEntry = 160;  // of a map of names, about
  return sizeof r + kEntry * r.values.values().size();
}

size_t pictureBytes(const Sky& sky) {
  if (!sky.image) return 0;
  // Besides the pixels, the map for sampling them is of about their size.
  return 2 * sizeof(vec3) * sky.image->pixels.pixels.size() +
         (sky.image->file ? sky.image->file->size() : 0);
}

}  // namespace

size_t EditNodes::bytes() const { return sizeof *this + bytesOf(before_) + bytesOf(after_); }
size_t EditRender::bytes() const { return sizeof *this + bytesOf(before_) + bytesOf(after_); }
size_t EditSky::bytes() const {
  const bool isSamePicture = before_.image == after_.image;
  return sizeof *this + (isSamePicture ? 0 : pictureBytes(before_) + pictureBytes(after_));
}
size_t AddNodes::bytes() const { return sizeof *this + bytesOf(nodes_); }
size_t DeleteNodes::bytes() const {
  size_t sum = sizeof *this;
  for (const auto& [index, node] : removed_) sum += sizeof index + bytesOf(node);
  return sum;
}

EditNodes::EditNodes(std::string label, const Document& document, std::vector<Node> after)
    : label_(std::move(label)) {
  for (Node& node : after) {
    const Node* now = document.scene.find(node.id);
    if (now == nullptr) continue;
    before_.push_back(*now);
    after_.push_back(std::move(node));
  }
}

void EditNodes::put(Document& document, const std::vector<Node>& nodes) {
  for (const Node& node : nodes) {
    if (Node* now = document.scene.find(node.id)) *now = node;
  }
}

bool EditNodes::absorb(const Command& later) {
  const auto* other = dynamic_cast<const EditNodes*>(&later);
  const auto sameId = [](const Node& a, const Node& b) { return a.id == b.id; };
  if (other == nullptr || !std::equal(after_.begin(), after_.end(), other->after_.begin(),
                                      other->after_.end(), sameId)) {
    return false;
  }
  after_ = other->after_;
  return true;
}

EditMaterial::EditMaterial(const Document& document, int index, Material after)
    : index_(index),
      before_(document.scene.materials[static_cast<size_t>(index)]),
      after_(std::move(after)) {}

std::string EditMaterial::label() const { return "Change material " + after_.name; }

bool EditMaterial::absorb(const Command& later) {
  const auto* other = dynamic_cast<const EditMaterial*>(&later);
  if (other == nullptr || other->index_ != index_) return false;
  after_ = other->after_;
  return true;
}

EditRender::EditRender(const Document& document, RenderSettings after)
    : before_(document.render), after_(std::move(after)) {}

bool EditRender::absorb(const Command& later) {
  const auto* other = dynamic_cast<const EditRender*>(&later);
  if (other == nullptr) return false;
  after_ = other->after_;
  return true;
}

bool EditSky::absorb(const Command& later) {
  const auto* other = dynamic_cast<const EditSky*>(&later);
  if (other == nullptr) return false;
  after_ = other->after_;
  return true;
}

void AddNodes::apply(Document& document) {
  document.scene.nodes.insert(document.scene.nodes.end(), nodes_.begin(), nodes_.end());
}

void AddNodes::revert(Document& document) {
  // They stand at the end: whatever came after them was undone before.
  document.scene.nodes.resize(document.scene.nodes.size() - nodes_.size());
}

namespace {

// For each node of the scene whether it is one of `ids` or hangs below one.
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

}  // namespace

DeleteNodes::DeleteNodes(const Document& document, const std::vector<NodeId>& ids, std::string verb)
    : verb_(std::move(verb)) {
  const std::vector<bool> gone = withDescendants(document.scene, ids);
  for (size_t i = 0; i < gone.size(); ++i) {
    if (gone[i]) removed_.emplace_back(i, document.scene.nodes[i]);
  }
}

std::string DeleteNodes::label() const {
  return removed_.size() == 1 ? verb_ + " " + removed_.front().second.name : verb_ + " objects";
}

void DeleteNodes::apply(Document& document) {
  std::vector<Node>& nodes = document.scene.nodes;
  for (auto r = removed_.rbegin(); r != removed_.rend(); ++r)
    nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(r->first));
}

void DeleteNodes::revert(Document& document) {
  std::vector<Node>& nodes = document.scene.nodes;
  for (const auto& [index, node] : removed_)
    nodes.insert(nodes.begin() + static_cast<std::ptrdiff_t>(index), node);
}

Copies copyNodes(Scene& scene, const std::vector<NodeId>& ids) {
  const std::vector<NodeId> roots = topmost(scene, ids);
  const std::vector<bool> copied = withDescendants(scene, roots);
  const std::unordered_set<NodeId> isRoot(roots.begin(), roots.end());
  Copies out;
  std::unordered_map<NodeId, NodeId> newId;
  for (size_t i = 0; i < copied.size(); ++i) {
    if (!copied[i]) continue;
    Node n = scene.nodes[i];
    newId[n.id] = scene.nextId;
    if (isRoot.contains(n.id)) out.roots.push_back(scene.nextId);
    n.id = scene.nextId++;
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
                   "a level takes copies up to " + std::to_string(kMostNodes) + " objects");
}

}  // namespace lamplighter
