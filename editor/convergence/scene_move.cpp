#include "editor/convergence/scene_move.h"

#include <map>
#include <string_view>

namespace lamplighter {
namespace {

// For each item of `from` its counterpart in `to`; null: there is none.
template <typename Item>
std::vector<const Item*> counterparts(const std::vector<Item>& from, const std::vector<Item>& to) {
  std::multimap<std::string_view, const Item*> left;  // keeps the order of equal names
  for (const Item& item : to) left.emplace(item.name, &item);
  std::vector<const Item*> found;
  found.reserve(from.size());
  for (const Item& item : from) {
    const auto first = left.lower_bound(item.name);
    const bool has = first != left.end() && first->first == item.name;
    found.push_back(has ? first->second : nullptr);
    if (has) left.erase(first);
  }
  return found;
}

// The node with the transform and the light of `there`. It does not become a light, or stop being
// one.
Node moved(Node node, const Node& there) {
  node.local = there.local;
  if (node.punctual && there.punctual) node.punctual = there.punctual;
  if (node.area && there.area) node.area = there.area;
  node.light.on = there.light.on;
  node.light.solo = there.light.solo;
  return node;
}

}  // namespace

SceneMove moveTo(const Scene& from, const Scene& to) {
  SceneMove move;
  const std::vector<const Node*> nodes = counterparts(from.nodes, to.nodes);
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i]) continue;
    ++move.common;
    Node node = moved(from.nodes[i], *nodes[i]);
    if (!(node == from.nodes[i])) move.nodes.push_back(std::move(node));
  }
  const std::vector<const Material*> materials = counterparts(from.materials, to.materials);
  for (size_t i = 0; i < materials.size(); ++i)
    if (materials[i] && materials[i]->emissive != from.materials[i].emissive)
      move.glows.emplace_back(static_cast<int>(i), materials[i]->emissive);
  if (!(to.sky == from.sky)) move.sky = to.sky;
  return move;
}

void applyMove(Editing& editing, const SceneMove& move) {
  Transaction edit = editing.begin("Move");
  edit.setNodes(move.nodes);
  for (const auto& [material, emissive] : move.glows) edit.material(material).emissive = emissive;
  if (move.sky) edit.sky() = *move.sky;
  edit.commit();
}

}  // namespace lamplighter
