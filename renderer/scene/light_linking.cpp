#include "renderer/scene/light_linking.h"

#include <map>

#include "renderer/scene/scene.h"

namespace lamplighter {

namespace {

using List = std::vector<NodeId>;

// The list without nodes that no longer exist.
List listOf(const Scene& scene, const LightState& state) {
  List list = state.leftOut;
  std::erase_if(list, [&](NodeId id) { return scene.find(id) == nullptr; });
  return list;
}

// Calls visit(index of the node or −1 for the sky, list) for each light with a non-empty list.
template <typename Visit>
void forEachList(const Scene& scene, Visit visit) {
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].light.leftOut.empty() || !emitsLight(scene, scene.nodes[i])) continue;
    if (const List list = listOf(scene, scene.nodes[i].light); !list.empty())
      visit(static_cast<int>(i), list);
  }
  if (scene.skyLight.leftOut.empty()) return;
  if (const List list = listOf(scene, scene.skyLight); !list.empty()) visit(-1, list);
}

}  // namespace

LightLinks lightLinks(const Scene& scene) {
  LightLinks links;
  links.ofLight.assign(scene.nodes.size(), 0);
  links.leftOutBy.assign(scene.nodes.size(), 0);
  std::map<List, uint8_t> linkOf;
  forEachList(scene, [&](int node, const List& list) {
    const auto known = linkOf.find(list);
    if (known == linkOf.end() && linkOf.size() == kMostLinks) return;
    const uint8_t link =
        known == linkOf.end()
            ? linkOf.emplace(list, static_cast<uint8_t>(linkOf.size() + 1)).first->second
            : known->second;
    (node < 0 ? links.ofSky : links.ofLight[static_cast<size_t>(node)]) = link;
  });
  links.count = static_cast<uint32_t>(linkOf.size());
  if (links.count == 0) return links;
  // Parents precede children, which inherit their bits.
  std::map<NodeId, uint32_t> bits;
  for (const auto& [list, link] : linkOf)
    for (const NodeId id : list) bits[id] |= 1u << (link - 1);
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& n = scene.nodes[i];
    const auto own = bits.find(n.id), above = bits.find(n.parent);
    const uint32_t all =
        (own == bits.end() ? 0 : own->second) | (above == bits.end() ? 0 : above->second);
    if (all != 0) bits[n.id] = all;
    links.leftOutBy[i] = all;
  }
  return links;
}

uint32_t countLinks(const Scene& scene) {
  std::map<List, bool> lists;
  forEachList(scene, [&](int, const List& list) { lists[list] = true; });
  return static_cast<uint32_t>(lists.size());
}

}  // namespace lamplighter
