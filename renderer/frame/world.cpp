#include "renderer/frame/world.h"

namespace lamplighter {

RenderSceneChanges World::updated(const Scene& scene, const SceneChanges& changes) {
  RenderSceneChanges found = lamplighter::update(*scene_, scene, changes);
  if (!rays_)
    rays_ = std::make_unique<RayCaster>(*scene_);
  else if (!found.none())
    rays_->update(found);
  const float unit = unitFor(spacing_.update(*scene_, *rays_, found));
  if (unit == scene_->unit) return found;
  found = setUnit(*scene_, scene, unit);
  rays_->update(found);
  spacing_.update(*scene_, *rays_, found);
  return found;
}

RenderSceneChanges World::update(const Scene& scene, const SceneChanges& changes) {
  try {
    return updated(scene, rays_ ? changes : SceneChanges::all());
  } catch (...) {
    rays_.reset();
    *scene_ = {};
    throw;
  }
}

}  // namespace lamplighter
