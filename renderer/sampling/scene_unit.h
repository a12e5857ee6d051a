// The unit of length that suits a level. Constants of the renderer (distance clamp, patches,
// charts, grids, offsets of rays) are meant for levels in metres. A level whose surfaces are as far
// apart as in a room that is 1,024 times as large, say one in millimetres, is rendered in a larger
// unit, and has the same picture as in metres.
#pragma once

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/surface_sampler.h"

namespace lamplighter {

// How far apart the surfaces of a level are: upper quartiles of the lengths of rays that leave
// surfaces with cosine-distributed directions and hit something [m]; 0: too few hit anything.
struct Spacing {
  float ofTriangles = 0.0f;  // from points of random triangles: spacing of modelled objects
  float ofArea = 0.0f;       // from points distributed by area: spacing of walls and ground
};

// The unit for a level [m]: a power of two, and 1 for levels of ordinary size.
//   2¹⁰ᵏ where both spacings are 128 m or more (rooms in millimetres),
//   2⁻⁷ or less where both are below 1/16 m (rooms in hundreds of metres, or in kilometres).
// Both are needed, because ground and sky domes have a large area and few triangles, and statues
// have many triangles and a small area. If one is 0, only the other is used; 1 m if both are 0.
float unitFor(const Spacing& spacing);

// Computes the spacing of a level that is edited.
class SceneSpacing {
 public:
  // Call it after each update of the scene and the rays. Deterministic; it depends only on the
  // scene and is the same in each unit. 512 rays if surfaces changed, otherwise none.
  const Spacing& update(const RenderScene& scene, const RayCaster& rays,
                        const RenderSceneChanges& changes);

 private:
  SurfaceSampler surfaces_;
  Spacing spacing_;
};

}  // namespace lamplighter
