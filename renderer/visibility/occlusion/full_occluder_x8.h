// From which of up to eight lights one polygon hides all of a patch: the same bits as
// OcclusionPyramid says of each.
#pragma once

#include "renderer/visibility/occlusion/light_packet.h"
#include "renderer/visibility/occlusion/occlusion_pyramid.h"

namespace lamplighter {

class FullOccluderX8 {
 public:
  using Mask = LightPacket::Mask;

  // Of lights for which the patch is neither dark nor degenerate. Refers to both, which must
  // outlive it.
  FullOccluderX8(const LightPacket& lights, const PatchRegion& region);
  FullOccluderX8(const LightPacket& lights, PatchRegion&& region) = delete;

  // Whose axis may meet the box, see OcclusionPyramid::Axis.
  Mask mayMeet(const Bounds& box) const;
  // Of some lights, those whose pyramid the polygon stands wholly across.
  Mask cut(const OccluderPolygon& polygon, Mask of) const;

 private:
  const LightPacket& lights_;
  const PatchRegion& region_;
  // Of the axes: their beginnings, give or take the margin, and one over their lengths.
  alignas(32) std::array<LightPacket::Floats, 3> low_, high_, inverse_;
  alignas(32) LightPacket::Floats inset_;  // by how much a polygon has to be larger [m]
};

}  // namespace lamplighter
