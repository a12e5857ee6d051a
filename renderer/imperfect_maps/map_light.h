// A light sample with a shadow map.
#pragma once

#include "shaders/shared/vpl.h"

namespace lamplighter {

struct MapLight {
  shared::Vpl vpl;
  float clampDistance = 0.5f;  // d0 of the bounded geometry term [m]
};

}  // namespace lamplighter
