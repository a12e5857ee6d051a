// Vector arithmetic for eight lights. Sums have the same order as in glm, so the results are
// bit-equal.
#pragma once

#include "renderer/base/simd.h"
#include "renderer/visibility/occlusion/light_packet.h"
#include "renderer/visibility/occlusion/pyramid_sides.h"

namespace lamplighter::lanes {

static_assert(LightPacket::kLights == hn::MaxLanes(kTag));
using Vec = Floats8;
using Vec3 = SimdVec3<Vec>;

HWY_INLINE Vec set(float v) { return hn::Set(kTag, v); }
HWY_INLINE Vec3 set(const vec3& v) { return {set(v.x), set(v.y), set(v.z)}; }

HWY_INLINE Vec load(const LightPacket::Floats& v) { return hn::Load(kTag, v.data()); }
HWY_INLINE Vec3 load(const std::array<LightPacket::Floats, 3>& v) {
  return {load(v[0]), load(v[1]), load(v[2])};
}

HWY_INLINE Vec dot(const Vec3& a, const Vec3& b) { return dotUnfused(a, b); }

}  // namespace lamplighter::lanes
