// The space of a light with a shadow map: x and y span its plane, z points to the side that it
// lights.
#pragma once

#include "renderer/base/math.h"
#include "shaders/shared/vpl.h"

namespace lamplighter::cpu {

struct LightSpace {
  bool isParallel;
  vec3 origin;
  mat3 axes;         // columns: those of light space
  float across, up;  // scale factors; 1 except for directional lights
  float most;        // largest value of a map, at the nearest distance that a ray can hit

  explicit LightSpace(const shared::Vpl& vpl);
};

}  // namespace lamplighter::cpu
