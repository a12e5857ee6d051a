// Where a sun's shadow maps lie: squares across its direction, small where the camera sees places
// that it may light and where the level has its detail.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

struct SunShadowTile {
  vec2 centre{0.0f};  // along the frame's first two axes, from the middle of the whole [m]
  float side = 0.0f;  // half of its width [m]
  uint32_t code = 1;  // names its place: 1 is the whole, 4·code + 0 … 3 are its quarters
};

// A place that is seen and that faces the sun.
struct SunPoint {
  vec2 at{0.0f};        // as SunShadowTile::centre
  float weight = 1.0f;  // how much it counts beside others
};

// Quarters a square of half-width `whole` about `middle`, always where halving the texels gains
// most, until there would be more than `count`: at the points, and by a smaller part where most of
// the scene is. Squares without any object are left out. `axes`: the frame's tangent, bitangent and
// normal.
std::vector<SunShadowTile> sunShadowTiles(const RenderScene& scene, const mat3& axes,
                                          const vec3& middle, float whole, int count,
                                          std::span<const SunPoint> points = {});

// Puts squares, at most `count` of them, in the place of each VPL that is the whole of a sun
// (parallel and no sample). `view`: whose picture they are for, if any.
void divideSuns(std::vector<SceneVpl>& vpls, const RenderScene& scene, const RayCaster& rays,
                const View* view, int count);

}  // namespace lamplighter
