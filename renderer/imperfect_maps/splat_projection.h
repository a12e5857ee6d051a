// Projection of points into the map of a light, eight at a time, for imperfect_map.cpp.
#pragma once

#include "renderer/base/simd.h"
#include "renderer/imperfect_maps/imperfect_map.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter {

inline constexpr size_t kSplatLanes = 8;
// The area of a disc as a multiple of the area that its point represents. Larger discs cover more
// of the surface, smaller ones reach less beyond its edges. Wrong pairs with 0.7, 1, 2: pillar_room
// 3.5, 3.0, 3.7%; zdm2 12.4, 9.2, 9.9%; bathroom 6.6, 6.5, 9.1%.
inline constexpr float kSplatArea = 1.0f;
// Minimum radius of a disc [texels].
inline constexpr float kSplatLeastRadius = 0.35f;
// Discs seen at a smaller sine than this are not drawn: they are thinner than a texel, and the
// surface on which the light itself lies must not block it.
inline constexpr float kSplatLeastSine = 0.01f;
// A disc whose nearest part is closer to the light than this, as a share of w, may cover any texel.
inline constexpr float kSplatNearest = 0.25f;

// By lane: a disc in the space of the light, with centre q, normal n and radius r.
struct SplatBatch {
  alignas(32) float plane[3][kSplatLanes];   // n/(n·q)
  alignas(32) float twiceQ[3][kSplatLanes];  // 2q
  alignas(32) float beyond[kSplatLanes];     // q² − r²
  // The texels whose centres it may cover.
  alignas(32) int32_t left[kSplatLanes], right[kSplatLanes], top[kSplatLanes], bottom[kSplatLanes];
};

class SplatProjection {
 public:
  SplatProjection(const shared::Vpl& light, int resolution, bool isBillboard)
      : isBillboard_(isBillboard),
        last_(static_cast<float>(resolution) - 1.0f),
        half_(broadcast(0.5f * static_cast<float>(resolution))),
        leastOfW_(broadcast(kSplatLeastRadius * 1.41421356f / static_cast<float>(resolution))),
        at_(broadcast(vec3(light.position))),
        tangent_(broadcast(vec3(light.tangent))),
        bitangent_(broadcast(glm::cross(vec3(light.normal), vec3(light.tangent)))),
        normal_(broadcast(vec3(light.normal))) {}

  // Projects eight points from index `first`. Returns the lanes to draw, one bit each.
  HWY_INLINE uint32_t project(const OccluderSpan& points, size_t first, SplatBatch& out) const;

 private:
  using Vector3 = SimdVec3<Floats8>;
  HWY_INLINE Vector3 turned(const Vector3& v) const {
    return {dotFused(v, tangent_), dotFused(v, bitangent_), dotFused(v, normal_)};
  }

  bool isBillboard_;
  float last_;
  Floats8 half_, leastOfW_;
  Vector3 at_, tangent_, bitangent_, normal_;
};

HWY_INLINE uint32_t SplatProjection::project(const OccluderSpan& points, size_t first,
                                             SplatBatch& out) const {
  const Floats8 zero = hn::Zero(kTag), one = broadcast(1.0f);
  const auto load = [&](const float* v) { return hn::LoadU(kTag, v + first); };
  const Vector3 towards = Vector3{load(points.x), load(points.y), load(points.z)} - at_;
  const Floats8 qz = dotFused(towards, normal_), area = load(points.area);
  const auto isAbove = hn::And(hn::Gt(qz, zero), hn::Gt(area, zero));
  if (hn::AllFalse(kTag, isAbove)) return 0;
  const Vector3 q{dotFused(towards, tangent_), dotFused(towards, bitangent_), qz};
  const Floats8 q2 = dotFused(q, q);
  const Vector3 n = isBillboard_ ? scaled(q, hn::Div(one, hn::Sqrt(q2)))
                                 : turned({load(points.nx), load(points.ny), load(points.nz)});
  const Floats8 nq = dotFused(n, q);
  const Floats8 w = hn::Add(hn::Add(hn::Abs(q.x), hn::Abs(q.y)), q.z);
  const Floats8 perW = hn::Div(one, w);
  const Floats8 s = hn::Mul(hn::Add(q.x, q.y), perW), t = hn::Mul(hn::Sub(q.x, q.y), perW);
  const Floats8 least = hn::Mul(w, leastOfW_);
  const Floats8 radius2 =
      hn::Max(hn::Mul(area, broadcast(kSplatArea / kPi)), hn::Mul(least, least));
  const Floats8 radius = hn::Sqrt(radius2);
  // How far the disc reaches in s and t, to first order, and exactly on a face: moving by δ moves
  // s by a·δ/(w + b·δ), with a = (1, 1, 0) − s·b and b = (±1, ±1, 1), where δ is normal to n.
  const Vector3 b{hn::CopySign(one, q.x), hn::CopySign(one, q.y), one};
  const auto reach = [&](const Vector3& a) {
    const Floats8 an = dotFused(a, n);
    return hn::Mul(radius, hn::Sqrt(hn::Max(hn::NegMulAdd(an, an, dotFused(a, a)), zero)));
  };
  const Floats8 nearest = hn::Sub(w, reach(b));
  const auto isNear = hn::Lt(nearest, hn::Mul(w, broadcast(kSplatNearest)));
  const Floats8 perNearest = hn::Div(half_, hn::Max(nearest, broadcast(1e-12f)));
  const Floats8 everywhere = hn::Mul(half_, broadcast(4.0f));
  const Floats8 reachS = hn::IfThenElse(
      isNear, everywhere,
      hn::Mul(reach({hn::NegMulAdd(s, b.x, one), hn::NegMulAdd(s, b.y, one), hn::Neg(s)}),
              perNearest));
  const Floats8 reachT = hn::IfThenElse(
      isNear, everywhere,
      hn::Mul(reach({hn::NegMulAdd(t, b.x, one), hn::Neg(hn::MulAdd(t, b.y, one)), hn::Neg(t)}),
              perNearest));
  const Floats8 middle = hn::Sub(half_, broadcast(0.5f));
  const Floats8 column = hn::MulAdd(s, half_, middle), row = hn::MulAdd(t, half_, middle);
  const Floats8 left = hn::Ceil(hn::Sub(column, reachS)),
                right = hn::Floor(hn::Add(column, reachS)), top = hn::Ceil(hn::Sub(row, reachT)),
                bottom = hn::Floor(hn::Add(row, reachT));
  const auto isWide =
      hn::Ge(hn::Mul(nq, nq), hn::Mul(q2, broadcast(kSplatLeastSine * kSplatLeastSine)));
  const uint32_t lanes =
      bitsOf(hn::And(hn::And(isAbove, isWide), hn::And(hn::Le(left, right), hn::Le(top, bottom))));
  if (lanes == 0) return 0;
  const Floats8 perNq = hn::Div(one, nq);
  const auto keep = [](Floats8 v, float(&to)[kSplatLanes]) { hn::Store(v, kTag, to); };
  const auto keepThree = [&](const Vector3& v, Floats8 scale, float(&to)[3][kSplatLanes]) {
    keep(hn::Mul(v.x, scale), to[0]);
    keep(hn::Mul(v.y, scale), to[1]);
    keep(hn::Mul(v.z, scale), to[2]);
  };
  keepThree(n, perNq, out.plane);
  keepThree(q, broadcast(2.0f), out.twiceQ);
  keep(hn::Sub(q2, radius2), out.beyond);
  const auto keepTexel = [&](Floats8 v, int32_t(&to)[kSplatLanes]) {
    const Floats8 inside = hn::Min(hn::Max(v, zero), broadcast(last_));
    hn::Store(truncateToInts(inside), hn::RebindToSigned<FloatTag>(), to);
  };
  keepTexel(left, out.left);
  keepTexel(right, out.right);
  keepTexel(top, out.top);
  keepTexel(bottom, out.bottom);
  return lanes;
}

}  // namespace lamplighter
