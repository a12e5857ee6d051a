// The space in which data of a mesh are the same for all of its instances: world space without the
// rotation and translation of the object, in units that keep the volume under its scale. Only a
// stretch makes a difference.
#pragma once

#include <optional>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

// The object's own space in the world: x_world = scale · rotation · x_own + translation.
struct OwnSpace {
  mat3 rotation{1.0f};
  // from node space to own space; rounded, so that a rotation does not change its bits
  mat3 stretch{1.0f};
  vec3 translation{0.0f};
  float scale = 1.0f;  // not rounded [m]
};

// None if the node flattens the object or the transform is not finite.
std::optional<OwnSpace> ownSpaceOf(const RenderObject& object);

}  // namespace lamplighter
