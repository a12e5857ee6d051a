// Planes of occlusion pyramids in the lanes of vectors: four or all planes of one light
// (pyramid_planes.h), or one plane of eight lights (pyramid_batch.h). Both do the same operations
// in the same order, with bit-equal results.
#pragma once

#include "renderer/visibility/occlusion/light_lanes.h"

namespace lamplighter {

// Fraction of rayEpsilon(): rounding error of sums such as the height above a plane. Positions may
// have larger errors, but then all nearby positions have the same error.
inline constexpr float kSumsRounding = 0.125f;

template <typename V>
struct PlaneLanes {
  SimdVec3<V> normal;  // unit, inwards; zero: the plane is left out
  V offset;            // inside: dot(normal, x) + offset >= 0
};

// Distances of points from planes; positive: inside.
template <typename V>
HWY_INLINE V distanceOf(const PlaneLanes<V>& plane, const SimdVec3<V>& point) {
  auto distance = hn::MulAdd(plane.normal.x, point.x, plane.offset);
  distance = hn::MulAdd(plane.normal.y, point.y, distance);
  return hn::MulAdd(plane.normal.z, point.z, distance);
}

// Distances of the innermost points of boxes.
template <typename V>
HWY_INLINE V depthOf(const PlaneLanes<V>& plane, const SimdVec3<V>& centre,
                     const SimdVec3<V>& half) {
  auto depth = distanceOf(plane, centre);
  depth = hn::MulAdd(hn::Abs(plane.normal.x), half.x, depth);
  depth = hn::MulAdd(hn::Abs(plane.normal.y), half.y, depth);
  return hn::MulAdd(hn::Abs(plane.normal.z), half.z, depth);
}

// The half-space in front of a light that is not parallel: no other gets light. Geometry in the
// light's plane, mainly the surface of the light, does not count as between.
template <typename Tag>
HWY_INLINE PlaneLanes<hn::Vec<Tag>> lightPlane(const LightLanes<Tag>& lights) {
  return {lights.towards, hn::Sub(hn::Neg(lights.margin), dotUnfused(lights.towards, lights.apex))};
}

// The side of a rectangle where the light is. Geometry in its plane, mainly the patch itself, does
// not count as between, but on a rough patch there may be geometry between its bumps.
template <typename Tag>
HWY_INLINE PlaneLanes<hn::Vec<Tag>> patchPlane(const LightLanes<Tag>& lights,
                                               const PatchRegion& region) {
  const Tag tag;
  const auto normal = setLanes(tag, region.normal), middle = setLanes(tag, region.middle());
  const auto isAbove = hn::Gt(dotUnfused(wayFrom(region.middle(), lights), normal), hn::Zero(tag));
  const auto turned = [&](auto v) { return hn::IfThenElse(isAbove, v, hn::Neg(v)); };
  const SimdVec3<hn::Vec<Tag>> up{turned(normal.x), turned(normal.y), turned(normal.z)};
  const auto slab = hn::Add(setLanes(tag, region.thickness), lights.margin);
  const auto slack = region.chart != kNone ? slab : hn::Mul(setLanes(tag, -3.0f), slab);
  return {up, hn::Sub(slack, dotUnfused(up, middle))};
}

// `from`: a corner of the patch; `side`: from it to the next corner; `way`: from the light to the
// corner, or towards the light if that is parallel; `up`: normal of the patch on the side of the
// light. A plane is left out if the rectangle lies almost in it, because its inner side is then
// unknown.
//
// Rays start and end at small offsets from both surfaces, so they may leave the exact pyramid: near
// the light by the offset there, near the patch by the offset there where the plane leans inwards.
// The planes include this slack at the patch and no more. Geometry hardly above the patch does not
// count as between; otherwise a wall at the edge of the patch would block all lights.
template <typename Tag, typename V = hn::Vec<Tag>>
HWY_INLINE PlaneLanes<V> sidePlanes(Tag tag, const SimdVec3<V>& from, const SimdVec3<V>& side,
                                    const SimdVec3<V>& way, const SimdVec3<V>& middle,
                                    const SimdVec3<V>& up, V thickness, V margin, bool parallel) {
  const auto all = [&](float v) { return hn::Set(tag, v); };
  const auto cross = [](const SimdVec3<V>& a, const SimdVec3<V>& b) {
    return SimdVec3<V>{hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
                       hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
                       hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
  };
  SimdVec3<V> n = cross(way, side);
  auto length = hn::Sqrt(hn::Max(dotFused(n, n), all(1e-30f)));
  const auto inside = hn::Div(dotFused(n, middle - from), length);
  const auto known = hn::Gt(hn::Abs(inside), margin);
  const auto slab = hn::Add(thickness, margin);
  if (!parallel) {
    // Passes through a point three margins outside the light: n·|n| + 3 m (n × side) / |n|. The
    // sign is reversed if n points outwards.
    const auto slack = hn::CopySign(hn::Div(hn::Mul(all(3.0f), slab), length), inside);
    const SimdVec3<V> t = cross(n, side);
    n = {hn::MulAdd(t.x, slack, n.x), hn::MulAdd(t.y, slack, n.y), hn::MulAdd(t.z, slack, n.z)};
    length = hn::Sqrt(dotFused(n, n));
  }
  const auto scale = hn::IfThenElseZero(known, hn::CopySign(hn::Div(all(1.0f), length), inside));
  n = {hn::Mul(n.x, scale), hn::Mul(n.y, scale), hn::Mul(n.z, scale)};
  const auto leaning = dotFused(n, up);
  const auto atPatch =
      hn::Add(hn::MulAdd(hn::Abs(leaning), thickness, hn::Mul(all(kSumsRounding), margin)),
              hn::Mul(hn::Max(hn::Neg(leaning), hn::Zero(tag)), hn::Mul(all(2.0f), slab)));
  return {n, hn::Sub(atPatch, dotFused(n, from))};
}

}  // namespace lamplighter
