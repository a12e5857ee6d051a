// What a change means for the renderer.
#include <algorithm>

#include "editor/edits/document_change.h"
#include "renderer/scene/scene_change_parts.h"

namespace lamplighter {

namespace {

template <typename K, typename T>
bool addsOrRemoves(const std::map<K, Change<T>>& changes) {
  return std::any_of(changes.begin(), changes.end(),
                     [](const auto& item) { return !item.second.before || !item.second.after; });
}

bool changesStructure(const DocumentChange& change) {
  return change.order.before || !change.meshes.empty() || !change.textures.empty() ||
         addsOrRemoves(change.materials) ||
         std::any_of(change.nodes.begin(), change.nodes.end(), [](const auto& item) {
           return !sameStructure(*item.second.before, *item.second.after);
         });
}

// Whether other lights may shine now, or leave out other objects. That depends on all lights.
bool changesLightStates(const DocumentChange& change, const Scene& after) {
  return change.skyLight.before || change.lightGroups.before ||
         (change.sky.before && anyLightDark(after)) ||
         std::any_of(change.nodes.begin(), change.nodes.end(),
                     [](const auto& item) {
                       return item.second.before->light != item.second.after->light;
                     }) ||
         std::any_of(change.materials.begin(), change.materials.end(), [](const auto& item) {
           return item.second.before->emits() != item.second.after->emits();
         });
}

}  // namespace

SceneChanges sceneChanges(const DocumentChange& change, const Scene& after) {
  const bool isStructure = changesStructure(change);
  if (!isStructure && changesLightStates(change, after)) {
    Document before;
    before.scene = after;
    change.revert(before);
    return compare(before.scene, after);
  }
  SceneChanges out;
  out.structure = isStructure;
  out.sky = change.sky.before.has_value();
  for (const auto& [index, material] : change.materials) {
    if (material.before && material.after)
      addMaterialChange(out, static_cast<int>(index), *material.before, *material.after);
  }
  if (isStructure) return out;  // all nodes are updated in any case
  for (const auto& [id, node] : change.nodes) addNodeChange(out, *node.before, *node.after);
  addMovedChildren(out, after);
  return out;
}

}  // namespace lamplighter
