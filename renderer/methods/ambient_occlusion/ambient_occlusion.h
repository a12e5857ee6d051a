// Ambient occlusion as a method: the level under a uniform sky that only near surfaces block.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

MethodInfo ambientOcclusionInfo();

}  // namespace lamplighter
