#include "renderer/visibility/occlusion/full_occluder_x8.h"

#include "renderer/base/simd.h"
#include "renderer/visibility/occlusion/packet_math.h"

namespace lamplighter {

using namespace lanes;

FullOccluderX8::FullOccluderX8(const LightPacket& lights, const PatchRegion& region)
    : lights_(lights), region_(region) {
  const Vec rounding = hn::Max(load(lights.rounding), set(region.rounding));
  const Vec thickness = set(region.thickness), eight = set(8.0f);
  const Vec margin = hn::Mul(eight, hn::Add(rounding, thickness));
  hn::Store(hn::Add(hn::Mul(eight, rounding), thickness), kTag, inset_.data());
  const vec3 middle = region.middle();
  const Vec least = set(1e-20f);
  for (int c = 0; c < 3; ++c) {
    const auto axis = static_cast<size_t>(c);
    const Vec begin = set(middle[c]);
    hn::Store(hn::Sub(begin, margin), kTag, low_[axis].data());
    hn::Store(hn::Add(begin, margin), kTag, high_[axis].data());
    Vec way = hn::Sub(load(lights.position[axis]), begin);
    way = hn::IfThenElse(hn::Gt(hn::Abs(way), least), way, hn::CopySign(least, way));
    hn::Store(hn::Div(set(1.0f), way), kTag, inverse_[axis].data());
  }
}

FullOccluderX8::Mask FullOccluderX8::mayMeet(const Bounds& box) const {
  Vec first = hn::Zero(kTag), last = set(1.0f);
  for (int c = 0; c < 3; ++c) {
    const auto axis = static_cast<size_t>(c);
    const Vec inverse = load(inverse_[axis]);
    const Vec a = hn::Mul(hn::Sub(set(box.min[c]), load(high_[axis])), inverse);
    const Vec b = hn::Mul(hn::Sub(set(box.max[c]), load(low_[axis])), inverse);
    first = hn::Max(first, hn::Min(a, b));
    last = hn::Min(last, hn::Max(a, b));
  }
  return lights_.all() & bitsOf(hn::Le(first, last));
}

FullOccluderX8::Mask FullOccluderX8::cut(const OccluderPolygon& polygon, Mask of) const {
  const vec3 &on = polygon.corners[0], &n = polygon.normal;
  const Vec3 apex = load(lights_.position);
  const Vec inset = load(inset_), zero = hn::Zero(kTag);
  const Vec lightSide = dot(set(n), apex - set(on));
  Mask cut = of & bitsOf(hn::Gt(hn::Abs(lightSide), inset));
  const auto keepThoseCutAt = [&](const vec3& corner) {
    const float cornerSide = glm::dot(n, corner - on);
    const Vec side = set(cornerSide);
    cut &= bitsOf(hn::And(hn::Lt(hn::Mul(side, lightSide), zero), hn::Gt(hn::Abs(side), inset)));
    if (cut == 0) return;
    const Vec part = hn::Div(lightSide, hn::Sub(lightSide, side));
    const Vec3 way = set(corner) - apex;
    const Vec3 across{hn::Add(apex.x, hn::Mul(part, way.x)), hn::Add(apex.y, hn::Mul(part, way.y)),
                      hn::Add(apex.z, hn::Mul(part, way.z))};
    for (size_t i = 0; i < polygon.edges.size() && cut != 0; ++i) {
      const OccluderPolygon::Edge& edge = polygon.edges[i];
      const Vec inwards = dot(set(edge.inwards), across - set(polygon.corners[i]));
      cut &= bitsOf(hn::Ge(inwards, hn::Mul(inset, set(edge.length))));
    }
  };
  // A rough patch has the thickness of its bumps, which matters at grazing angles.
  const bool isRough = region_.chart != kNone;
  const vec3 bump = isRough ? region_.thickness * region_.normal : vec3(0.0f);
  for (const vec3& corner : region_.points()) {
    if (cut != 0) keepThoseCutAt(corner + bump);
    if (cut != 0 && isRough) keepThoseCutAt(corner - bump);
  }
  return cut;
}

}  // namespace lamplighter
