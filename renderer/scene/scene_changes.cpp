#include "renderer/scene/scene_changes.h"

#include <algorithm>

#include "renderer/scene/light_linking.h"
#include "renderer/scene/light_picture.h"

namespace lamplighter {

namespace {

template <typename T>
void mergeSorted(std::vector<T>& into, const std::vector<T>& from) {
  into.insert(into.end(), from.begin(), from.end());
  std::sort(into.begin(), into.end());
  into.erase(std::unique(into.begin(), into.end()), into.end());
}

// Compares everything except the name, which does not affect rendering.
bool looksEqual(Material a, const Material& b) {
  a.name = b.name;
  return a == b;
}

bool meshEmits(const Scene& scene, Node node) {
  node.area.reset();
  node.punctual.reset();
  return emitsLight(scene, node);
}

bool sameStructure(const Scene& a, const Scene& b) {
  if (a.nodes.size() != b.nodes.size() || a.meshes != b.meshes || a.textures != b.textures ||
      a.materials.size() != b.materials.size()) {
    return false;
  }
  for (size_t i = 0; i < a.nodes.size(); ++i) {
    const Node &m = a.nodes[i], &n = b.nodes[i];
    if (m.id != n.id || m.parent != n.parent || m.mesh != n.mesh || m.visible != n.visible ||
        m.meshKind != n.meshKind || m.area.has_value() != n.area.has_value() ||
        m.punctual.has_value() != n.punctual.has_value()) {
      return false;
    }
    // A different shape has a different number of triangles.
    if (m.area && m.area->shape != n.area->shape) return false;
    // A different picture is a different texture.
    if (m.area && shownPicture(*m.area) != shownPicture(*n.area)) return false;
  }
  return true;
}

}  // namespace

void SceneChanges::merge(const SceneChanges& other) {
  everything |= other.everything;
  structure |= other.structure;
  sky |= other.sky;
  mergeSorted(moved, other.moved);
  mergeSorted(lights, other.lights);
  mergeSorted(materials, other.materials);
}

SceneChanges compare(const Scene& before, const Scene& after) {
  SceneChanges changes;
  changes.sky = before.sky != after.sky;
  for (size_t i = 0; i < std::min(before.materials.size(), after.materials.size()); ++i) {
    if (looksEqual(before.materials[i], after.materials[i])) continue;
    changes.materials.push_back(static_cast<int>(i));
    // Clear and masked surfaces change the occluders; emission changes the lights.
    if (before.materials[i].isClear() != after.materials[i].isClear()) changes.structure = true;
    // An object that is switched off has a material of its own.
    if (before.materials[i].emits() != after.materials[i].emits() && anyLightDark(after))
      changes.structure = true;
  }
  if (!sameStructure(before, after) || lightLinks(before) != lightLinks(after)) {
    changes.structure = true;
    return changes;  // all nodes are updated in any case
  }

  const ShiningLights shone = shiningLights(before), shining = shiningLights(after);
  changes.sky |= shone.sky != shining.sky;
  for (size_t i = 0; i < after.nodes.size(); ++i) {
    if (shone.nodes[i] == shining.nodes[i]) continue;
    const Node& n = after.nodes[i];
    if (n.area || n.punctual) changes.lights.push_back(n.id);
    if (n.mesh != kNone) changes.structure |= meshEmits(after, n);
  }

  // A node has moved if its own transform or that of any parent differs; parents come first.
  std::vector<NodeId> moved;
  for (size_t i = 0; i < after.nodes.size(); ++i) {
    const Node &m = before.nodes[i], &n = after.nodes[i];
    const bool parentMoved =
        n.parent != kNoNode && std::find(moved.begin(), moved.end(), n.parent) != moved.end();
    // The size of an area light changes its surface, like a move.
    const bool resized = n.area && m.area->size != n.area->size;
    if (parentMoved || resized || !(m.local == n.local)) moved.push_back(n.id);
    if ((n.area && !(*m.area == *n.area)) || (n.punctual && !(*m.punctual == *n.punctual)))
      changes.lights.push_back(n.id);
  }
  changes.moved = std::move(moved);
  std::sort(changes.moved.begin(), changes.moved.end());
  mergeSorted(changes.lights, {});
  return changes;
}

}  // namespace lamplighter
