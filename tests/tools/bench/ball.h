// A movable object for levels that have none.
#pragma once

#include "renderer/scene/scene.h"

namespace lamplighter {

// Adds a ball of one metre at the centre of the level.
NodeId addBall(Scene& scene);

}  // namespace lamplighter
