#include "renderer/scene/render_scene.h"

#include <algorithm>
#include <iterator>

namespace lamplighter {

void RenderSceneChanges::merge(const RenderSceneChanges& later) {
  rebuilt |= later.rebuilt;
  objects |= later.objects;
  materials |= later.materials;
  lights |= later.lights;
  sky |= later.sky;
  // The indices of emissions may be others.
  materials |= later.objects && !emissions.empty();
  gains |= later.gains;
  references |= later.references;
  if (rebuilt) {
    movedObjects.clear();
    movedBounds.clear();
    objects = false;
    emissions.clear();
    switchedObjects.clear();
    return;
  }
  std::vector<uint32_t> switched;
  std::ranges::set_union(switchedObjects, later.switchedObjects, std::back_inserter(switched));
  switchedObjects = std::move(switched);
  std::vector<int> both;
  std::set_union(emissions.begin(), emissions.end(), later.emissions.begin(), later.emissions.end(),
                 std::back_inserter(both));
  emissions = std::move(both);
  for (size_t i = 0; i < later.movedObjects.size(); ++i) {
    const uint32_t object = later.movedObjects[i];
    // An object that moved before keeps its first bounds.
    if (std::find(movedObjects.begin(), movedObjects.end(), object) != movedObjects.end()) continue;
    movedObjects.push_back(object);
    movedBounds.push_back(later.movedBounds[i]);
  }
}

RenderSceneChanges setUnit(RenderScene& render, const Scene& scene, float unit) {
  render.unit = unit;
  return update(render, scene, SceneChanges::all());
}

}  // namespace lamplighter
