// Lights in the lanes of vectors. The tests of this folder are templates over the Highway tag: for
// one light and for eight they do the same operations in the same order as GLM, with bit-equal
// results.
#pragma once

#include "renderer/base/simd.h"
#include "renderer/visibility/occlusion/light_packet.h"
#include "renderer/visibility/occlusion/occlusion_pyramid.h"

namespace lamplighter {

using OneLight = hn::FixedTag<float, 1>;
static_assert(LightPacket::kLights == hn::MaxLanes(kTag));

// The same value in all lanes.
template <typename Tag>
HWY_INLINE hn::Vec<Tag> setLanes(Tag tag, float v) {
  return hn::Set(tag, v);
}
template <typename Tag>
HWY_INLINE SimdVec3<hn::Vec<Tag>> setLanes(Tag tag, const vec3& v) {
  return {hn::Set(tag, v.x), hn::Set(tag, v.y), hn::Set(tag, v.z)};
}

HWY_INLINE Floats8 load(const LightPacket::Floats& v) { return hn::Load(kTag, v.data()); }
HWY_INLINE SimdVec3<Floats8> load(const std::array<LightPacket::Floats, 3>& v) {
  return {load(v[0]), load(v[1]), load(v[2])};
}

// What the tests of a patch need of its lights, which are all parallel or all not.
template <typename Tag>
struct LightLanes {
  using Vec = hn::Vec<Tag>;
  SimdVec3<Vec> apex;     // position; unused for parallel lights
  SimdVec3<Vec> towards;  // the light's normal; parallel: unit, towards the light
  Vec margin;             // rounding error of positions at the light and at the patch [m]
  LightMask all;          // lanes with a light of their own
  bool isParallel;
};

HWY_INLINE LightLanes<OneLight> lanesOf(const PyramidApex& light, const PatchRegion& region) {
  const OneLight tag;
  return {setLanes(tag, light.position), setLanes(tag, light.normal),
          setLanes(tag, std::max(light.rounding, region.rounding)), 1, light.isParallel};
}

HWY_INLINE LightLanes<FloatTag> lanesOf(const LightPacket& lights, const PatchRegion& region) {
  return {load(lights.position), load(lights.normal),
          hn::Max(load(lights.rounding), broadcast(region.rounding)), lights.all(), false};
}

// From a point to the light, or towards the light if it is parallel.
template <typename Tag>
HWY_INLINE SimdVec3<hn::Vec<Tag>> wayFrom(const vec3& point, const LightLanes<Tag>& lights) {
  return lights.isParallel ? lights.towards : lights.apex - setLanes(Tag(), point);
}

}  // namespace lamplighter
