// Finds for which of up to eight lights one polygon hides a whole patch. Bit-equal to
// OcclusionPyramid.
#pragma once

#include "renderer/visibility/occlusion/light_packet.h"
#include "renderer/visibility/occlusion/occlusion_pyramid.h"

namespace lamplighter {

class FullOccluderX8 {
 public:
  using Mask = LightPacket::Mask;

  // Only for lights for which the patch is neither dark nor degenerate. Keeps references to both
  // arguments, which must outlive this object.
  FullOccluderX8(const LightPacket& lights, const PatchRegion& region);
  FullOccluderX8(const LightPacket& lights, PatchRegion&& region) = delete;

  // Lights whose axis may meet the box, see OcclusionPyramid::Axis.
  Mask mayMeet(const Bounds& box) const;
  // Those of the lights `of` whose pyramid the polygon cuts completely.
  Mask cut(const OccluderPolygon& polygon, Mask of) const;

 private:
  const LightPacket& lights_;
  const PatchRegion& region_;
  // The axes: start points minus and plus the margin, and the reciprocals of their lengths.
  alignas(32) std::array<LightPacket::Floats, 3> low_, high_, inverse_;
  alignas(32) LightPacket::Floats inset_;  // distance of the polygon's border from the pyramid that
                                           // is required [m]
};

}  // namespace lamplighter
