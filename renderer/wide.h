// Eight floats, or as many bytes as these are, at a time, for whichever kernel needs it.
#pragma once

// x86-64-v3 has no AES instructions, which Highway wants of its AVX2 target unless told otherwise.
#ifndef HWY_DISABLE_PCLMUL_AES
#define HWY_DISABLE_PCLMUL_AES 1
#endif

#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

namespace lamplighter {

using WideFloats = hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::FixedTag<float, 8>>;
using WideInts = hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::FixedTag<int32_t, 8>>;

// A bit for each lane.
HWY_INLINE uint32_t bitsOf(hwy::HWY_NAMESPACE::Mask<hwy::HWY_NAMESPACE::FixedTag<float, 8>> lanes) {
  uint8_t bits[8];
  hwy::HWY_NAMESPACE::StoreMaskBits(hwy::HWY_NAMESPACE::FixedTag<float, 8>(), lanes, bits);
  return bits[0];
}
HWY_INLINE uint32_t
bitsOf(hwy::HWY_NAMESPACE::Mask<hwy::HWY_NAMESPACE::FixedTag<uint8_t, 32>> lanes) {
  uint32_t bits = 0;
  uint8_t bytes[8];
  hwy::HWY_NAMESPACE::StoreMaskBits(hwy::HWY_NAMESPACE::FixedTag<uint8_t, 32>(), lanes, bytes);
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
}

// To the nearest, ties to even. This and the next are for what is in range: Highway's own also put
// right what is not, at twice the cost.
HWY_INLINE WideInts roundToInts(WideFloats v) {
#if HWY_TARGET == HWY_AVX2
  return WideInts{_mm256_cvtps_epi32(v.raw)};
#else
  return hwy::HWY_NAMESPACE::NearestInt(v);
#endif
}

// Towards zero.
HWY_INLINE WideInts truncateToInts(WideFloats v) {
#if HWY_TARGET == HWY_AVX2
  return WideInts{_mm256_cvttps_epi32(v.raw)};
#else
  return hwy::HWY_NAMESPACE::ConvertTo(hwy::HWY_NAMESPACE::FixedTag<int32_t, 8>(), v);
#endif
}

}  // namespace lamplighter
