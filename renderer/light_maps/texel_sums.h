// Fixed-point sums of eight texels of a light map, for accumulate.cpp.
#pragma once

#include "renderer/base/simd.h"
#include "renderer/light_maps/accumulate.h"

namespace lamplighter::texels {

constexpr size_t kLanes = 8;
using Tag = FloatTag;
using IntTag = hn::FixedTag<int32_t, kLanes>;
using DoubleTag = hn::FixedTag<double, kLanes / 2>;
constexpr DoubleTag kDoubleTag;
using Floats = Floats8;
using Ints = hn::Vec<IntTag>;
using Doubles = hn::Vec<DoubleTag>;

// The sums of one channel.
class Sums {
 public:
  HWY_INLINE explicit Sums(const double* from)
      : low_(hn::LoadU(kDoubleTag, from)), high_(hn::LoadU(kDoubleTag, from + kLanes / 2)) {}
  HWY_INLINE void store(double* to) const {
    hn::StoreU(low_, kDoubleTag, to);
    hn::StoreU(high_, kDoubleTag, to + kLanes / 2);
  }
  HWY_INLINE void addRounded(Floats values) {
    const hn::Half<Tag> half;
    low_ = hn::Add(low_, rounded(hn::PromoteTo(kDoubleTag, hn::LowerHalf(half, values))));
    high_ = hn::Add(high_, rounded(hn::PromoteTo(kDoubleTag, hn::UpperHalf(half, values))));
  }
  HWY_INLINE void addUnits(Ints units) {
    const hn::Half<IntTag> half;
    const Doubles unit = hn::Set(kDoubleTag, kIrradianceUnit);
    low_ = hn::MulAdd(hn::PromoteTo(kDoubleTag, hn::LowerHalf(half, units)), unit, low_);
    high_ = hn::MulAdd(hn::PromoteTo(kDoubleTag, hn::UpperHalf(half, units)), unit, high_);
  }

 private:
  // Rounds to a multiple of kIrradianceUnit, ties to even: doubles of the size of `large` are such
  // multiples, so the sum is rounded to one, and the difference is exact.
  static HWY_INLINE Doubles rounded(Doubles values) {
    const Doubles large = hn::Set(kDoubleTag, 0x1.8p52 * kIrradianceUnit);
    return hn::Sub(hn::Add(values, large), large);
  }

  Doubles low_, high_;
};

// The sums of three channels.
struct PacketSums {
  Sums r, g, b;
  HWY_INLINE void addRounded(Floats weight, float red, float green, float blue) {
    r.addRounded(hn::Mul(weight, broadcast(red)));
    g.addRounded(hn::Mul(weight, broadcast(green)));
    b.addRounded(hn::Mul(weight, broadcast(blue)));
  }
};

}  // namespace lamplighter::texels
