// The space of a light with a shadow map: its plane is x and y, z the side that it lights.
#pragma once

#include "renderer/base/math.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::cpu {

struct LightSpace {
  bool isParallel;
  vec3 origin;
  mat3 axes;         // columns: those of light space
  float across, up;  // what it is scaled by; 1 but for parallel lights
  float most;        // of what a map stores: at the nearest that a ray meets

  explicit LightSpace(const shared::Vpl& vpl);
};

}  // namespace lamplighter::cpu
