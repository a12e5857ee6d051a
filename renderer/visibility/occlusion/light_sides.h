// Which lights need no pyramid on a patch, eight at a time: as OcclusionPyramid says of each.
#pragma once

#include "renderer/visibility/occlusion/light_lanes.h"
#include "renderer/visibility/occlusion/occlusion_pyramid.h"

namespace lamplighter {

struct LightSides {
  LightLanes::Mask dark = 0;
  LightLanes::Mask degenerate = 0;  // of those that are not dark

  LightSides(const LightLanes& lights, const PatchRegion& region);
};

}  // namespace lamplighter
