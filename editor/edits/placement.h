// The position and rotation of an object that is placed on a surface.
#pragma once

#include <optional>

#include "renderer/scene/scene.h"

namespace lamplighter {

struct SurfacePoint {
  vec3 position{0.0f};
  vec3 normal{0.0f, 1.0f, 0.0f};  // unit, towards the viewer
};

// Distance of the node's origin from a surface with unit normal n [m], such that the node and its
// descendants just touch the surface: meshes with their lowest point, lights with a gap of 0.01
// units of `unit` metres.
float standOff(const Scene& scene, NodeId id, const vec3& n, float unit);

// The node's local transform on the surface: objects keep their rotation, lights face away from the
// surface, with the gap of standOff(). None if the parent's transform has no volume.
std::optional<Transform> placedOn(const Scene& scene, NodeId id, const SurfacePoint& at,
                                  float unit);

// The smallest rotation that maps one unit direction to another.
quat leastTurn(const vec3& from, const vec3& to);

// Whether the parent's transform has an inverse. If not (a scale of 0), no descendant can be placed
// at a given position.
bool hasVolume(const mat4& m);

}  // namespace lamplighter
