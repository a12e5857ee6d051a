// An object to move about in levels that have none of their own.
#pragma once

#include "renderer/scene/scene.h"

namespace lamplighter {

// Puts a ball of a metre into the middle of the level.
NodeId addBall(Scene& scene);

}  // namespace lamplighter
