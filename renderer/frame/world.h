// A scene in the unit that suits it, and rays in it.
#pragma once

#include <memory>

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/scene_unit.h"
#include "renderer/scene/scene_changes.h"
#include "renderer/scene/units.h"

namespace lamplighter {

class World {
 public:
  // Updates scene() and rays() for the changes since the last call; all() in the first one. If the
  // level now suits another unit, both are built anew, as from a fresh start. Throws what Embree
  // throws; then everything is dropped, and the next call builds it anew.
  RenderSceneChanges update(const Scene& scene, const SceneChanges& changes);

  const RenderScene& scene() const { return *scene_; }
  const RayCaster* rays() const { return rays_.get(); }  // null before the first update
  // A view with lengths in metres, as the renderer takes it.
  View viewOf(const View& metres) const { return inUnits(metres, scene_->unit); }

 private:
  // At a fixed address, because the rays refer to it.
  std::unique_ptr<RenderScene> scene_ = std::make_unique<RenderScene>();
  std::unique_ptr<RayCaster> rays_;
  SceneSpacing spacing_;

  RenderSceneChanges updated(const Scene& scene, const SceneChanges& changes);
};

}  // namespace lamplighter
