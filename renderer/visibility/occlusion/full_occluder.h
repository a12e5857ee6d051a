// Finds for which lights one polygon hides a whole patch.
#pragma once

#include <array>
#include <limits>

#include "renderer/visibility/occlusion/light_lanes.h"

namespace lamplighter {

template <typename Tag>
class FullOccluder {
 public:
  // Only for lights for which the patch is neither dark nor degenerate. Keeps references to both
  // arguments, which must outlive this object.
  FullOccluder(const LightLanes<Tag>& lights, const PatchRegion& region)
      : lights_(lights),
        region_(region),
        inset_(hn::Add(hn::Mul(set(8.0f), lights.margin), set(region.thickness))) {
    const Vec margin = hn::Mul(set(8.0f), hn::Add(lights.margin, set(region.thickness)));
    const SimdVec3<Vec> middle = set(region.middle()), way = wayFrom(region.middle(), lights);
    const auto reciprocal = [](Vec v) {
      const Vec least = set(1e-20f);
      return hn::Div(set(1.0f),
                     hn::IfThenElse(hn::Gt(hn::Abs(v), least), v, hn::CopySign(least, v)));
    };
    axes_ = {Axis{hn::Sub(middle.x, margin), hn::Add(middle.x, margin), reciprocal(way.x)},
             Axis{hn::Sub(middle.y, margin), hn::Add(middle.y, margin), reciprocal(way.y)},
             Axis{hn::Sub(middle.z, margin), hn::Add(middle.z, margin), reciprocal(way.z)}};
  }
  FullOccluder(const LightLanes<Tag>& lights, PatchRegion&& region) = delete;
  FullOccluder(LightLanes<Tag>&& lights, const PatchRegion& region) = delete;

  // Lights for which the segment from the centre of the patch to the light may meet the box. A
  // polygon that cuts the whole pyramid must meet it, and it meets far fewer boxes than the pyramid
  // does.
  LightMask mayMeet(const Bounds& box) const {
    Vec first = hn::Zero(Tag());
    Vec last = set(lights_.isParallel ? std::numeric_limits<float>::max() : 1.0f);
    for (int c = 0; c < 3; ++c) {
      const Axis& axis = axes_[static_cast<size_t>(c)];
      const Vec a = hn::Mul(hn::Sub(set(box.min[c]), axis.high), axis.inverse);
      const Vec b = hn::Mul(hn::Sub(set(box.max[c]), axis.low), axis.inverse);
      first = hn::Max(first, hn::Min(a, b));
      last = hn::Min(last, hn::Max(a, b));
    }
    return lights_.all & bitsOf(Tag(), hn::Le(first, last));
  }

  // Those of the lights `of` whose pyramid the polygon cuts completely between light and patch.
  LightMask cut(const OccluderPolygon& polygon, LightMask of) const {
    const SimdVec3<Vec> n = set(polygon.normal);
    const Vec lightSide = dotUnfused(n, wayFrom(polygon.corners[0], lights_));
    const Vec least = lights_.isParallel ? set(1e-4f) : inset_;
    LightMask cut = of & bitsOf(Tag(), hn::Gt(hn::Abs(lightSide), least));
    // A rough patch has the thickness of its bumps, which matters at grazing angles.
    const bool isRough = region_.chart != kNone;
    const vec3 bump = isRough ? region_.thickness * region_.normal : vec3(0.0f);
    for (const vec3& corner : region_.points()) {
      if (cut != 0) cut = cutAt(corner + bump, polygon, lightSide, cut);
      if (cut != 0 && isRough) cut = cutAt(corner - bump, polygon, lightSide, cut);
    }
    return cut;
  }

 private:
  using Vec = hn::Vec<Tag>;
  struct Axis {
    Vec low, high;  // start point of the segment minus and plus the margin [m]
    Vec inverse;    // reciprocal of its length [1/m]
  };
  static HWY_INLINE Vec set(float v) { return setLanes(Tag(), v); }
  static HWY_INLINE SimdVec3<Vec> set(const vec3& v) { return setLanes(Tag(), v); }

  // Those of the lights `of` that the polygon hides from one corner of the patch.
  LightMask cutAt(const vec3& corner, const OccluderPolygon& polygon, Vec lightSide,
                  LightMask of) const {
    const Vec side = set(glm::dot(polygon.normal, corner - polygon.corners[0]));
    LightMask cut = of & bitsOf(Tag(), hn::And(hn::Lt(hn::Mul(side, lightSide), hn::Zero(Tag())),
                                               hn::Gt(hn::Abs(side), inset_)));
    if (cut == 0) return 0;
    const SimdVec3<Vec> at = set(corner);
    // Where the segment from the corner to the light meets the plane of the polygon.
    const SimdVec3<Vec> across =
        lights_.isParallel ? at - scaled(lights_.towards, hn::Div(side, lightSide))
                           : lights_.apex + scaled(at - lights_.apex,
                                                   hn::Div(lightSide, hn::Sub(lightSide, side)));
    for (size_t i = 0; i < polygon.edges.size() && cut != 0; ++i) {
      const OccluderPolygon::Edge& edge = polygon.edges[i];
      const Vec inwards = dotUnfused(set(edge.inwards), across - set(polygon.corners[i]));
      cut &= bitsOf(Tag(), hn::Ge(inwards, hn::Mul(inset_, set(edge.length))));
    }
    return cut;
  }

  const LightLanes<Tag>& lights_;
  const PatchRegion& region_;
  std::array<Axis, 3> axes_;
  Vec inset_;  // distance of the polygon's border from the pyramid that is required [m]
};

}  // namespace lamplighter
