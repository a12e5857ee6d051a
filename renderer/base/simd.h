// Vectors of floats, or of as many bytes as these are, for whichever kernel needs them; and the one
// place that includes Highway.
#pragma once

// x86-64-v3 has no AES instructions, which Highway wants of its AVX2 target unless told otherwise.
#define HWY_DISABLE_PCLMUL_AES 1

#include <cstdint>
#include <cstring>
#include <vector>

#include <hwy/highway.h>

#include "renderer/base/math.h"

namespace lamplighter {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::FixedTag<float, 8>;
using Floats8 = hn::Vec<FloatTag>;
using Ints8 = hn::Vec<hn::FixedTag<int32_t, 8>>;
inline constexpr FloatTag kTag;

// Places or directions, as many as V has lanes.
template <typename V>
struct SimdVec3 {
  V x, y, z;
};
HWY_INLINE Floats8 wide(float v) { return hn::Set(kTag, v); }
HWY_INLINE SimdVec3<Floats8> wide(const vec3& v) { return {wide(v.x), wide(v.y), wide(v.z)}; }
HWY_INLINE Floats8 wideAt(const std::vector<float>& v, size_t at) {
  return hn::LoadU(kTag, &v[at]);
}
template <typename V>
HWY_INLINE SimdVec3<V> operator-(const SimdVec3<V>& a, const SimdVec3<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
// The bits of glm's, as the next.
template <typename V>
HWY_INLINE SimdVec3<V> cross(const SimdVec3<V>& a, const SimdVec3<V>& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}
template <typename V>
HWY_INLINE V dotUnfused(const SimdVec3<V>& a, const SimdVec3<V>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
// Quicker, and rounded less.
template <typename V>
HWY_INLINE V dotFused(const SimdVec3<V>& a, const SimdVec3<V>& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

// A bit for each lane.
HWY_INLINE uint32_t bitsOf(hn::Mask<FloatTag> lanes) {
  uint8_t bits[8];
  hn::StoreMaskBits(FloatTag(), lanes, bits);
  return bits[0];
}
HWY_INLINE uint32_t bitsOf(hn::Mask<hn::FixedTag<uint8_t, 32>> lanes) {
  uint32_t bits = 0;
  uint8_t bytes[8];
  hn::StoreMaskBits(hn::FixedTag<uint8_t, 32>(), lanes, bytes);
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
}

// To the nearest, ties to even. This and the next are for what is in range: Highway's own also put
// right what is not, at twice the cost.
HWY_INLINE Ints8 roundToInts(Floats8 v) {
#if HWY_TARGET == HWY_AVX2
  return Ints8{_mm256_cvtps_epi32(v.raw)};
#else
  return hn::NearestInt(v);
#endif
}

// Towards zero.
HWY_INLINE Ints8 truncateToInts(Floats8 v) {
#if HWY_TARGET == HWY_AVX2
  return Ints8{_mm256_cvttps_epi32(v.raw)};
#else
  return hn::ConvertTo(hn::FixedTag<int32_t, 8>(), v);
#endif
}

}  // namespace lamplighter
