// Shadow volumes of point lights (ShadowVolume::Cone) in the lanes of vectors.
#pragma once

#include "renderer/visibility/occlusion/light_lanes.h"

namespace lamplighter {

template <typename Tag>
struct ConeLanes {
  using Vec = hn::Vec<Tag>;
  SimdVec3<Vec> apex, axis;
  Vec nearest, sine, cosine;
};

// Bit i: the shadow of lane i may fall on the sphere, see ShadowVolume::mayFallOn().
template <typename Tag>
HWY_INLINE LightMask conesMayFallOn(const ConeLanes<Tag>& cones, const vec3& centre, float radius) {
  const Tag tag;
  const auto zero = hn::Zero(tag), size = setLanes(tag, radius);
  const auto v = setLanes(tag, centre) - cones.apex;
  const auto distance2 = dotUnfused(v, v), gap = hn::Sub(cones.nearest, size);
  const auto isNear = hn::And(hn::Gt(gap, zero), hn::Lt(distance2, hn::Mul(gap, gap)));
  const auto along = dotUnfused(v, cones.axis), along2 = hn::Mul(along, along);
  const auto across2 = hn::Max(hn::Sub(distance2, along2), zero);
  const auto cosine2 = hn::Mul(cones.cosine, cones.cosine);
  // Behind the light, where the apex is the nearest point of the cone.
  const auto isBehind =
      hn::And(hn::Lt(along, zero),
              hn::Le(hn::Mul(hn::Mul(across2, cones.sine), cones.sine), hn::Mul(along2, cosine2)));
  const auto isAround = hn::Le(distance2, setLanes(tag, radius * radius));
  const auto reach = hn::Add(size, hn::Mul(along, cones.sine));
  const auto isIn =
      hn::And(hn::Ge(reach, zero), hn::Le(hn::Mul(across2, cosine2), hn::Mul(reach, reach)));
  return bitsOf(
      tag, hn::AndNot(isNear, hn::Or(hn::And(isBehind, isAround), hn::AndNot(isBehind, isIn))));
}

}  // namespace lamplighter
