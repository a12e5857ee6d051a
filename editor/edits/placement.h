// Where an object comes to lie when it is put on a surface.
#pragma once

#include <optional>

#include "renderer/scene/scene.h"

namespace lamplighter {

struct SurfacePoint {
  vec3 position{0.0f};
  vec3 normal{0.0f, 1.0f, 0.0f};  // unit, towards the viewer
};

// How far the node's own origin must stand off along the surface's unit normal n so that it and all
// below it only just touch: meshes with their lowest point, lights a little above. Metres.
float standOff(const Scene& scene, NodeId id, const vec3& n);

// The node's local transform when it is put there: objects stand as they are turned, lights face
// away from the surface. None when its parent squeezes space flat.
std::optional<Transform> placedOn(const Scene& scene, NodeId id, const SurfacePoint& at);

// The least rotation that takes one unit direction to another.
quat leastTurn(const vec3& from, const vec3& to);

// A parent that squeezes space flat has no inverse: nothing below it can be put at a place.
bool hasVolume(const mat4& m);

}  // namespace lamplighter
