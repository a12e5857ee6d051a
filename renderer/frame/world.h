// A scene in a unit that suits its size, and a ray caster for it.
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
  // level now needs another unit, both are built from scratch. Throws the exceptions of Embree;
  // then everything is discarded, and the next call builds it again.
  RenderSceneChanges update(const Scene& scene, const SceneChanges& changes);

  const RenderScene& scene() const { return *scene_; }
  const RayCaster* rays() const { return rays_.get(); }  // null before the first update
  // Converts a view with lengths in metres to the unit of scene().
  View viewOf(const View& metres) const { return inUnits(metres, scene_->unit); }

 private:
  // At a fixed address, because the ray caster refers to it.
  std::unique_ptr<RenderScene> scene_ = std::make_unique<RenderScene>();
  std::unique_ptr<RayCaster> rays_;
  SceneSpacing spacing_;

  RenderSceneChanges updated(const Scene& scene, const SceneChanges& changes);
};

}  // namespace lamplighter
