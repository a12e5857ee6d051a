// Finds the lights that need no pyramid for a patch, eight at a time. Same results as
// OcclusionPyramid.
#pragma once

#include "renderer/visibility/occlusion/light_packet.h"
#include "renderer/visibility/occlusion/occlusion_pyramid.h"

namespace lamplighter {

struct BackFacingLights {
  LightPacket::Mask dark = 0;
  LightPacket::Mask degenerate = 0;  // bit i: light i; only lights that are not dark

  BackFacingLights(const LightPacket& lights, const PatchRegion& region);
};

}  // namespace lamplighter
