// Which lights need no pyramid on a patch, eight at a time: as OcclusionPyramid says of each.
#pragma once

#include "renderer/visibility/occlusion/light_packet.h"
#include "renderer/visibility/occlusion/occlusion_pyramid.h"

namespace lamplighter {

struct BackFacingLights {
  LightPacket::Mask dark = 0;
  LightPacket::Mask degenerate = 0;  // of those that are not dark

  BackFacingLights(const LightPacket& lights, const PatchRegion& region);
};

}  // namespace lamplighter
