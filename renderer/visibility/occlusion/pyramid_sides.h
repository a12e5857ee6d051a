// The planes of an occlusion pyramid through its light and the sides of its patch, for
// occlusion_pyramid.cpp, the four sides of one light at a time, and pyramid_batch.cpp, one side of
// eight lights: the same operations, so that both get the same bits.
#pragma once

#include "renderer/base/simd.h"

namespace lamplighter {

// Of rayEpsilon(): what rounding makes of a sum such as the height over a plane. A place may be
// wrong by more, but then with all that lies there.
inline constexpr float kSumsRounding = 0.125f;

template <typename V>
struct SidePlanes {
  SimdVec3<V> normal;  // unit, inwards; zero: it is left out
  V offset;            // inside: dot(normal, x) + offset >= 0
};

// `from`: a corner of the patch, `side`: from it to the next, `way`: to the corner from the light,
// or towards the light where that is parallel; `up`: the patch's normal, towards the light. A plane
// that the rectangle hardly leaves is left out, since it is not known on which side it is.
//
// Rays begin and end a little off both surfaces, and so may leave the exact pyramid: near the light
// by what they stand off it, near the patch by what they begin over it, where the side leans
// inwards. There is no more slack than that at the patch, and what is hardly higher is not between:
// a wall that the patch ends at would be, for all lights.
template <typename Tag, typename V = hwy::HWY_NAMESPACE::Vec<Tag>>
HWY_INLINE SidePlanes<V> sidePlanes(Tag tag, const SimdVec3<V>& from, const SimdVec3<V>& side,
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
    // Through a place three margins farther out than the light: n·|n| + 3 m (n × side) / |n|, and
    // the way out is the other one where n points outwards.
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
