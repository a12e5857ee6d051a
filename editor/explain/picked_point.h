// A point of a surface that a person pointed at, and that goes where its object goes.
#pragma once

#include <optional>

#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/scene.h"

namespace lamplighter {

// World space; the unit normals are on the side that was looked at.
struct PickedPoint {
  NodeId node = kNoNode;
  vec3 position{0.0f};
  vec3 normal{0.0f, 1.0f, 0.0f};           // that light is reflected about
  vec3 geometricNormal{0.0f, 1.0f, 0.0f};  // of the triangle
  uint32_t leftOutBy = 0;                  // the object's, as of then (light_linking.h)
};

// What the ray through an image point (pixels) meets; nothing where it leaves the level.
std::optional<PickedPoint> surfaceAt(const RenderScene& scene, const RayCaster& rays,
                                     const View& view, const vec2& pixel);

// The point in the space of its node, so that it can be found again after the node has moved.
class Anchor {
 public:
  Anchor(const Scene& scene, const PickedPoint& point);
  // Nothing when the node is gone.
  std::optional<PickedPoint> placedIn(const Scene& scene) const;

 private:
  PickedPoint local_;
};

}  // namespace lamplighter
