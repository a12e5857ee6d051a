// A lamp at the camera that lights dark scenes during editing. It is added to the rendered scene,
// never to the document.
#pragma once

#include "renderer/scene/camera.h"
#include "renderer/scene/scene_changes.h"

namespace lamplighter {

// No node of a document has this id.
inline constexpr NodeId kWorkLight = ~NodeId{0};

// The intensity [cd] that makes a grey surface at a distance [m] clearly visible at an exposure.
float workLightIntensity(float distance, float exposureEv);

// The rendered scene. Copies the document's scene only while the work light is on.
class WorkLight {
 public:
  // `changes` receives the changes of the result since the last call.
  const Scene& with(const Scene& scene, const View& view, float intensity, SceneChanges& changes);

 private:
  Scene lit_;
  Node lamp_;
  bool isOn_ = false;
};

}  // namespace lamplighter
