// A lamp at the camera that lights dark scenes while they are worked on. It is put into the scene
// that is rendered, never into the document.
#pragma once

#include "renderer/scene/camera.h"
#include "renderer/scene/scene_changes.h"

namespace lamplighter {

// Never given to a node of a document.
inline constexpr NodeId kWorkLight = ~NodeId{0};

// Candela by which a grey surface at a distance [m] is well to be seen at an exposure.
float workLightIntensity(float distance, float exposureEv);

// The scene that is rendered. Copies it while there is a work light.
class WorkLight {
 public:
  // `changes` become those of the result since the last call.
  const Scene& with(const Scene& scene, const View& view, float intensity, SceneChanges& changes);

 private:
  Scene lit_;
  Node lamp_;
  bool isOn_ = false;
};

}  // namespace lamplighter
