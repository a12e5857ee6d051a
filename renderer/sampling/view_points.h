// Points that the camera sees. Light samples are chosen, and suns divided, by their contribution at
// these points.
#pragma once

#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// A point that the camera sees, offset from its surface to the visible side. World space, metres.
struct SeenPoint {
  vec3 position, normal;
  uint32_t leftOutBy = 0;  // light_linking.h
  bool operator==(const SeenPoint&) const = default;
};

// At most `count` points that the camera sees, starting at index `first` of their sequence, evenly
// distributed over the picture and slightly beyond its edges. Each subrange of the result is also
// evenly distributed. Depends only on scene, view, count and first; of the view's size only the
// aspect ratio matters.
std::vector<SeenPoint> seenPoints(const RenderScene& scene, const RayCaster& rays, const View& view,
                                  int count, int first = 0);

// The view for which VPLs are chosen: eye and direction of the camera snapped to a grid (half a
// metre, 15°), so that small camera motions change no VPL. If a surface is between the eye and the
// grid point, the eye is not snapped. Depends only on the current camera and scene, not on earlier
// ones.
View steadyView(const View& view, const RayCaster& rays);

}  // namespace lamplighter
