// A surface point that the user picked. It moves with its object.
#pragma once

#include <optional>

#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/scene.h"

namespace lamplighter {

// World space, in metres. The unit normals point to the side that the camera sees.
struct PickedPoint {
  NodeId node = kNoNode;
  vec3 position{0.0f};
  vec3 normal{0.0f, 1.0f, 0.0f};           // shading normal
  vec3 geometricNormal{0.0f, 1.0f, 0.0f};  // of the triangle
  // light-linking mask of the object when the point was picked (light_linking.h)
  uint32_t leftOutBy = 0;
};

// The same point with its position in units of `unit` metres.
PickedPoint inUnits(const PickedPoint& metres, float unit);

// The first surface on the ray through an image point (pixels) of a view in metres. Nothing if the
// ray leaves the level.
std::optional<PickedPoint> surfaceAt(const RenderScene& scene, const RayCaster& rays,
                                     const View& metres, const vec2& pixel);

// The point in the local space of its node, so that it moves with the node.
class Anchor {
 public:
  Anchor(const Scene& scene, const PickedPoint& point);
  // Nothing if the node is gone.
  std::optional<PickedPoint> placedIn(const Scene& scene) const;

 private:
  PickedPoint local_;
};

}  // namespace lamplighter
