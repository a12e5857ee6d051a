// Divides a sun into shadow map tiles: squares perpendicular to its direction, small where the
// camera sees lit surfaces and where the level has detail.
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
  vec2 centre{0.0f};  // along the first two axes of the frame, from the centre of the undivided
                      // square [m]
  float side = 0.0f;  // half of its width [m]
  uint32_t code = 1;  // position in the quadtree: 1 is the whole, 4·code + 0 … 3 are the quarters
};

// A visible point that faces the sun.
struct SunPoint {
  vec2 at{0.0f};        // like SunShadowTile::centre
  float weight = 1.0f;  // relative weight among the points
};

// Divides a square with half-width `whole` around `middle` into quarters, up to `count` tiles. Each
// step divides the tile where halving the texel size gains most: at the points, and with a smaller
// weight where most of the scene is. Tiles without objects are dropped. `axes`: tangent, bitangent
// and normal of the frame.
std::vector<SunShadowTile> sunShadowTiles(const RenderScene& scene, const mat3& axes,
                                          const vec3& middle, float whole, int count,
                                          std::span<const SunPoint> points = {});

// Replaces each VPL that is a whole sun (parallel and not a sample) by at most `count` tiles.
// `view`: the view to optimise for, or null.
void divideSuns(std::vector<SceneVpl>& vpls, const RenderScene& scene, const RayCaster& rays,
                const View* view, int count);

}  // namespace lamplighter
