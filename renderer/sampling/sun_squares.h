// Where a sun's shadow maps lie: squares across its direction, small where the level has its
// detail.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

struct SunSquare {
  vec2 centre{0.0f};  // along the frame's first two axes, from the middle of the whole [m]
  float side = 0.0f;  // half of its width [m]
  uint32_t code = 1;  // names its place: 1 is the whole, 4·code + 0 … 3 are its quarters
};

// Quarters a square of half-width `whole` about `middle`, always where most of the scene is
// in squares that are still large, until there would be more than `count`. Squares without any
// object are left out. `axes`: the frame's tangent, bitangent and normal.
std::vector<SunSquare> sunSquares(const RenderScene& scene, const mat3& axes, const vec3& middle,
                                  float whole, int count);

}  // namespace lamplighter
