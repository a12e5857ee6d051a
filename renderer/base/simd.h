// Vectors of 8 floats, or of the same number of bytes, for all kernels. This is the only file that
// includes Highway.
#pragma once

// Highway's AVX2 target expects AES instructions by default; x86-64-v3 does not have them.
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

// One position or direction per lane of V.
template <typename V>
struct SimdVec3 {
  V x, y, z;
};
HWY_INLINE Floats8 broadcast(float v) { return hn::Set(kTag, v); }
HWY_INLINE SimdVec3<Floats8> broadcast(const vec3& v) {
  return {broadcast(v.x), broadcast(v.y), broadcast(v.z)};
}
HWY_INLINE Floats8 loadAt(const std::vector<float>& v, size_t at) {
  return hn::LoadU(kTag, &v[at]);
}
template <typename V>
HWY_INLINE SimdVec3<V> operator-(const SimdVec3<V>& a, const SimdVec3<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <typename V>
HWY_INLINE SimdVec3<V> operator+(const SimdVec3<V>& a, const SimdVec3<V>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <typename V>
HWY_INLINE SimdVec3<V> scaled(const SimdVec3<V>& v, V factor) {
  return {hn::Mul(v.x, factor), hn::Mul(v.y, factor), hn::Mul(v.z, factor)};
}
// Bit-equal to glm; so is the next function.
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
// Faster and with less rounding error than dotUnfused().
template <typename V>
HWY_INLINE V dotFused(const SimdVec3<V>& a, const SimdVec3<V>& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

// One bit per lane, of at most 8.
template <typename Tag>
HWY_INLINE uint32_t bitsOf(Tag tag, hn::Mask<Tag> lanes) {
  uint8_t bits[8];
  hn::StoreMaskBits(tag, lanes, bits);
  return bits[0];
}
HWY_INLINE uint32_t bitsOf(hn::Mask<FloatTag> lanes) { return bitsOf(kTag, lanes); }
HWY_INLINE uint32_t bitsOf(hn::Mask<hn::FixedTag<uint8_t, 32>> lanes) {
  uint32_t bits = 0;
  uint8_t bytes[8];
  hn::StoreMaskBits(hn::FixedTag<uint8_t, 32>(), lanes, bytes);
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
}

// Rounds to nearest, ties to even. This function and the next require values in the range of int32;
// Highway's own functions also handle others, at twice the cost.
HWY_INLINE Ints8 roundToInts(Floats8 v) {
#if HWY_TARGET == HWY_AVX2
  return Ints8{_mm256_cvtps_epi32(v.raw)};
#else
  return hn::NearestInt(v);
#endif
}

// Rounds towards zero.
HWY_INLINE Ints8 truncateToInts(Floats8 v) {
#if HWY_TARGET == HWY_AVX2
  return Ints8{_mm256_cvttps_epi32(v.raw)};
#else
  return hn::ConvertTo(hn::FixedTag<int32_t, 8>(), v);
#endif
}

}  // namespace lamplighter
