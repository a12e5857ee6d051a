#include "renderer/scene/scene_changes.h"

#include <algorithm>
#include <unordered_set>

#include "renderer/scene/light_linking.h"
#include "renderer/scene/light_picture.h"
#include "renderer/scene/scene_change_parts.h"

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

bool sameStructure(const Scene& a, const Scene& b) {
  return a.meshes == b.meshes && a.textures == b.textures &&
         a.materials.size() == b.materials.size() &&
         std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(),
                    [](const Node& m, const Node& n) { return sameStructure(m, n); });
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

bool sameStructure(const Node& m, const Node& n) {
  return m.id == n.id && m.parent == n.parent && m.mesh == n.mesh && m.visible == n.visible &&
         m.meshKind == n.meshKind && m.area.has_value() == n.area.has_value() &&
         m.punctual.has_value() == n.punctual.has_value() &&
         // A different shape has a different number of triangles; a different picture is a
         // different texture.
         (!m.area ||
          (m.area->shape == n.area->shape && shownPicture(*m.area) == shownPicture(*n.area)));
}

void addMaterialChange(SceneChanges& changes, int index, const Material& before,
                       const Material& after) {
  if (looksEqual(before, after)) return;
  changes.materials.push_back(index);
  // Clear and masked surfaces change the occluders.
  if (before.isClear() != after.isClear()) changes.structure = true;
}

void addNodeChange(SceneChanges& changes, const Node& m, const Node& n) {
  // The size of an area light changes its surface, like a move.
  const bool resized = n.area && m.area->size != n.area->size;
  if (resized || !(m.local == n.local)) changes.moved.push_back(n.id);
  if ((n.area && !(*m.area == *n.area)) || (n.punctual && !(*m.punctual == *n.punctual)))
    changes.lights.push_back(n.id);
}

void addMovedChildren(SceneChanges& changes, const Scene& after) {
  std::unordered_set<NodeId> moved(changes.moved.begin(), changes.moved.end());
  if (!moved.empty()) {
    for (const Node& n : after.nodes) {  // parents come first
      if (n.parent != kNoNode && moved.contains(n.parent) && moved.insert(n.id).second)
        changes.moved.push_back(n.id);
    }
  }
  mergeSorted(changes.moved, {});
  mergeSorted(changes.lights, {});
}

SceneChanges compare(const Scene& before, const Scene& after) {
  SceneChanges changes;
  changes.sky = before.sky != after.sky;
  for (size_t i = 0; i < std::min(before.materials.size(), after.materials.size()); ++i)
    addMaterialChange(changes, static_cast<int>(i), before.materials[i], after.materials[i]);
  if (!sameStructure(before, after) || lightLinks(before) != lightLinks(after)) {
    changes.structure = true;
    return changes;  // all nodes are updated in any case
  }

  const ShiningLights shone = shiningLights(before), shining = shiningLights(after);
  changes.sky |= shone.sky != shining.sky;
  for (size_t i = 0; i < after.nodes.size(); ++i) {
    const Node& n = after.nodes[i];
    addNodeChange(changes, before.nodes[i], n);
    if (shone.nodes[i] == shining.nodes[i]) continue;
    changes.lights.push_back(n.id);
  }
  addMovedChildren(changes, after);
  return changes;
}

}  // namespace lamplighter
