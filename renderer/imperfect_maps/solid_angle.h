// Solid angles of triangles [sr]. A. Van Oosterom and J. Strackee, "The Solid Angle of a Plane
// Triangle", IEEE Transactions on Biomedical Engineering 30(2), 1983. Paper 2 uses them as the
// importance of triangles (section 5.1).
#pragma once

#include "renderer/base/simd.h"

namespace lamplighter {

// The solid angle of the triangle abc around `at`, all in the same space, in [0, 2π] sr. Computed
// in double precision. 2π at a point within the triangle; 0 at a corner and for a triangle without
// area. It is discontinuous at an edge, where rounding may give any value between.
float solidAngle(const vec3& at, const vec3& a, const vec3& b, const vec3& c);

// The same in [−2π, 2π] sr: negative where `at` is in front of the triangle, that is, sees its
// corners in counter-clockwise order. The sum over a closed mesh with outward faces is 4π at points
// inside and 0 at points outside.
float signedSolidAngle(const vec3& at, const vec3& a, const vec3& b, const vec3& c);

// atan2(y, x) in [0, π] for y ≥ 0 in each lane, with a relative error of at most 4e-7; 0 where both
// are 0.
HWY_INLINE Floats8 upperAtan2(Floats8 y, Floats8 x) {
  const Floats8 absX = hn::Abs(x);
  const Floats8 largest = hn::Max(hn::Max(y, absX), broadcast(std::numeric_limits<float>::min()));
  const Floats8 t = hn::Div(hn::Min(y, absX), largest);
  // atan(t) on [0, 1]: the coefficients of Abramowitz and Stegun (1964), formula 4.4.49.
  const Floats8 s = hn::Mul(t, t);
  Floats8 p = broadcast(0.0028662257f);
  for (const float c : {-0.0161657367f, 0.0429096138f, -0.0752896400f, 0.1065626393f,
                        -0.1420889944f, 0.1999355085f, -0.3333314528f, 1.0f})
    p = hn::MulAdd(p, s, broadcast(c));
  p = hn::Mul(p, t);
  p = hn::IfThenElse(hn::Gt(y, absX), hn::Sub(broadcast(0.5f * kPi), p), p);
  return hn::IfThenElse(hn::Lt(x, broadcast(0.0f)), hn::Sub(broadcast(kPi), p), p);
}

// solidAngle() of a triangle and a point per lane, in single precision: the error is at most 1e-6
// of the value plus 2e-6 sr where the triangle is not much smaller than the coordinates around
// `at`.
HWY_INLINE Floats8 solidAngle8(const SimdVec3<Floats8>& at, const SimdVec3<Floats8>& a,
                               const SimdVec3<Floats8>& b, const SimdVec3<Floats8>& c) {
  const SimdVec3<Floats8> p = a - at, q = b - at, r = c - at;
  const Floats8 lp = hn::Sqrt(dotFused(p, p)), lq = hn::Sqrt(dotFused(q, q)),
                lr = hn::Sqrt(dotFused(r, r));
  // p·(q × r), without the cancellation for small triangles far away.
  const SimdVec3<Floats8> normal = cross(b - a, c - a);
  const Floats8 volume = hn::Abs(dotFused(p, normal));
  Floats8 sum = hn::Mul(hn::Mul(lp, lq), lr);
  sum = hn::MulAdd(dotFused(p, q), lr, sum);
  sum = hn::MulAdd(dotFused(q, r), lp, sum);
  sum = hn::MulAdd(dotFused(r, p), lq, sum);
  const Floats8 angle = hn::Mul(broadcast(2.0f), upperAtan2(volume, sum));
  return hn::IfThenElseZero(hn::Gt(dotFused(normal, normal), broadcast(0.0f)), angle);
}

}  // namespace lamplighter
