// Sums of places and directions of eight lights, in the order in which glm adds them up, so that
// they are the same bits. Files that include it define HWY_DISABLE_PCLMUL_AES first, see
// pyramid_sides.h.
#pragma once

#include "renderer/visibility/light_lanes.h"
#include "renderer/visibility/pyramid_sides.h"
#include "renderer/wide.h"

namespace lamplighter::lanes {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::FixedTag<float, LightLanes::kLights>;
constexpr Tag kTag;
using Vec = hn::Vec<Tag>;
using Vec3 = Lanes3<Vec>;

HWY_INLINE Vec set(float v) { return hn::Set(kTag, v); }
HWY_INLINE Vec3 set(const vec3& v) { return {set(v.x), set(v.y), set(v.z)}; }

HWY_INLINE Vec load(const LightLanes::Floats& v) { return hn::Load(kTag, v.data()); }
HWY_INLINE Vec3 load(const std::array<LightLanes::Floats, 3>& v) {
  return {load(v[0]), load(v[1]), load(v[2])};
}

HWY_INLINE Vec3 sub(const Vec3& a, const Vec3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vec dot(const Vec3& a, const Vec3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

}  // namespace lamplighter::lanes
