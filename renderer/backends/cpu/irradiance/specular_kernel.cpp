#include "renderer/backends/cpu/irradiance/specular_kernel.h"

#include <algorithm>

#include "renderer/backends/cpu/irradiance/simd_light.h"
#include "renderer/scene/light_linking.h"
#include "shaders/shared/vpl_speculars.h"

namespace lamplighter::cpu {

// The points of a packet and their lobes.
struct GlossyPoints {
  Vector3 position, shading, geometric, toEye;
  bool isFlat;
  Mask meant;
  Floats alpha2, nv;
  Vector3 straight;  // F0
  Floats grazing;    // F at 90°
};

constexpr hn::FixedTag<double, kLanes / 2> kHalf{};

// Sums of eight lanes. Each contribution is rounded to a multiple of 2⁻³⁰, so doubles add and
// subtract without rounding errors (up to 2²³ W/(m² sr)) and in any order.
struct ExactSum {
  hn::Vec<decltype(kHalf)> low = hn::Zero(kHalf), high = hn::Zero(kHalf);

  template <Sign kSign>
  HWY_INLINE void add(Floats value) {
    // Floats of at least 2⁻⁷ are such multiples.
    const Floats small = broadcast(0x1p-7f);
    const Floats bounded = hn::Min(value, broadcast(0x1p20f));
    const Floats rounded = hn::Sub(hn::Add(bounded, small), small);
    const Floats exact = hn::IfThenElse(hn::Lt(bounded, small), rounded, bounded);
    const hn::FixedTag<float, kLanes / 2> half;
    const auto a = hn::PromoteTo(kHalf, hn::LowerHalf(half, exact));
    const auto b = hn::PromoteTo(kHalf, hn::UpperHalf(half, exact));
    low = kSign == Sign::add ? hn::Add(low, a) : hn::Sub(low, a);
    high = kSign == Sign::add ? hn::Add(high, b) : hn::Sub(high, b);
  }
  void store(double* to) const {
    hn::StoreU(low, kHalf, to);
    hn::StoreU(high, kHalf, to + kLanes / 2);
  }
};

// Faster sums, for pictures that are summed from scratch each time.
struct FloatSum {
  Floats value = hn::Zero(kTag);

  template <Sign kSign>
  HWY_INLINE void add(Floats more) {
    value = kSign == Sign::add ? hn::Add(value, more) : hn::Sub(value, more);
  }
  void store(double* to) const {
    HWY_ALIGN float lanes[kLanes];
    hn::Store(value, kTag, lanes);
    std::copy_n(lanes, kLanes, to);
  }
};

template <typename Sum>
struct SumsOf3 {
  Sum r, g, b;
};

namespace {

GlossyPoints pointsAt(const GBuffer& g, const vec3& from, size_t first, uint8_t lanes,
                      std::span<const Gloss, kLanes> gloss, float leastRoughness) {
  HWY_ALIGN float alpha2[kLanes], nv[kLanes], grazing[kLanes];
  HWY_ALIGN float straight[3][kLanes], eye[3][kLanes];
  for (size_t lane = 0; lane < kLanes; ++lane) {
    const size_t i = first + lane;
    const vec3 way = from - vec3(g.px[i], g.py[i], g.pz[i]);
    const vec3 toEye = way / std::max(glm::length(way), 1e-20f);
    const shared::Lobe lobe =
        shared::makeLobe(g.albedo(i), gloss[lane].metallic, gloss[lane].roughness, leastRoughness,
                         glm::dot(toEye, vec3(g.sx[i], g.sy[i], g.sz[i])));
    alpha2[lane] = lobe.shape.x;
    nv[lane] = lobe.shape.y;
    grazing[lane] = lobe.straight.w;
    for (int c = 0; c < 3; ++c) {
      straight[c][lane] = lobe.straight[c];
      eye[c][lane] = toEye[c];
    }
  }
  const auto load = [](const float* v) { return hn::Load(kTag, v); };
  const Vectors positions(g.px, g.py, g.pz), shadings(g.sx, g.sy, g.sz),
      geometrics(g.gx, g.gy, g.gz);
  return {positions.at(first),
          shadings.at(first),
          geometrics.at(first),
          {load(eye[0]), load(eye[1]), load(eye[2])},
          g.isFlat[first / kLanes] != 0,
          hn::LoadMaskBits(kTag, &lanes),
          load(alpha2),
          load(nv),
          {load(straight[0]), load(straight[1]), load(straight[2])},
          load(grazing)};
}

// shared::lobeTowards times `weight`, for light of this colour.
template <Sign kSign, typename Sum>
HWY_INLINE void addLobe(const GlossyPoints& p, const Vector3& colour, Floats weight, Floats nl,
                        Floats lv, Floats solidAngle, SumsOf3<Sum>& sum) {
  const Floats one = broadcast(1.0f), half = broadcast(0.5f);
  const Floats vh = hn::Sqrt(hn::Max(hn::MulAdd(half, lv, half), broadcast(1e-6f)));
  const Floats inverse = hn::Div(one, vh);
  const Floats a2 = hn::Min(
      hn::MulAdd(hn::Mul(solidAngle, broadcast(shared::kSpread / (4.0f * kPi))), inverse, p.alpha2),
      one);
  const Floats nh = hn::Mul(hn::Mul(half, hn::Add(nl, p.nv)), inverse);
  const Floats nh2 = hn::Min(hn::Mul(nh, nh), one);
  const Floats d = hn::MulAdd(nh2, hn::Sub(a2, one), one);
  const auto side = [&](Floats a, Floats b) {
    const Floats rest = hn::MulAdd(hn::Mul(b, b), hn::Sub(one, a2), a2);
    return hn::Mul(a, hn::Sqrt(rest));
  };
  const Floats masking = hn::Add(side(nl, p.nv), side(p.nv, nl));
  const Floats dv =
      hn::Div(hn::Mul(hn::Mul(a2, broadcast(0.5f / kPi)), weight), hn::Mul(hn::Mul(d, d), masking));
  const Floats m = hn::Sub(one, vh), m2 = hn::Mul(m, m);
  const Floats grazing = hn::Mul(hn::Mul(m2, m2), m);
  const auto add = [&](Floats straight, Floats light, Sum& to) {
    const Floats f = hn::MulAdd(grazing, hn::Sub(p.grazing, straight), straight);
    to.template add<kSign>(hn::Mul(hn::Mul(dv, light), f));
  };
  add(p.straight.x, colour.x, sum.r);
  add(p.straight.y, colour.y, sum.g);
  add(p.straight.z, colour.z, sum.b);
}

// Adds or subtracts the light that is reflected towards the eye.
template <LightRecord::Kind kKind, Sign kSign, typename Sum>
HWY_INLINE void addSpecular(const GlossyPoints& p, const SimdLight& light, float footprint,
                            bool readsShadowMap, const SimdConstants& c, SumsOf3<Sum>& sum) {
  const Floats zero = hn::Zero(kTag);
  const Vector3 v{hn::Sub(p.position.x, light.position.x), hn::Sub(p.position.y, light.position.y),
                  hn::Sub(p.position.z, light.position.z)};
  const Vector3& geometric = p.isFlat ? p.shading : p.geometric;
  Mask lit;
  Mask occluded = hn::MaskFromVec(zero);
  Floats weight, nl, lv, solidAngle = zero;
  if constexpr (kKind == LightRecord::Kind::directional) {
    const Vector3 q{dot(v, light.tangent), dot(v, light.bitangent), dot(v, light.normal)};
    const Floats facing = dot(geometric, light.normal);
    const Mask within = hn::And(hn::And(hn::Ge(q.x, hn::Neg(light.side)), hn::Lt(q.x, light.side)),
                                hn::And(hn::Ge(q.y, hn::Neg(light.side)), hn::Lt(q.y, light.side)));
    nl = dot(p.shading, light.normal);
    lit = hn::And(hn::And(p.meant, within), hn::And(hn::Gt(nl, zero), hn::Gt(facing, zero)));
    if (hn::AllFalse(kTag, lit)) return;
    lv = dot(light.normal, p.toEye);
    weight = nl;
    solidAngle = broadcast(footprint);
    if (readsShadowMap) occluded = directionalOccluded(light, c, q, geometric, facing);
  } else {
    const Floats z = dot(v, light.normal);
    const Floats s = hn::Neg(dot(p.shading, v));
    const Floats facing = p.isFlat ? s : hn::Neg(dot(geometric, v));
    lit =
        hn::And(hn::And(p.meant, hn::Gt(z, zero)), hn::And(hn::Gt(s, zero), hn::Gt(facing, zero)));
    if (hn::AllFalse(kTag, lit)) return;
    if (readsShadowMap)
      occluded = hemisphereOccluded(
          light, c, v, hn::IfThenElse(lit, z, broadcast(1.0f)),
          [&] { return inFrameOf(light, geometric); }, facing);
    const Floats d2 = hn::Max(dot(v, v), broadcast(1e-12f));
    const Floats inverse = hn::Div(broadcast(1.0f), hn::Sqrt(d2));
    nl = hn::Mul(s, inverse);
    lv = hn::Neg(hn::Mul(dot(v, p.toEye), inverse));
    // Cosine at the light. Clamped in lanes behind the light, so that no lobe becomes infinite.
    const Floats away = hn::Max(hn::Mul(z, inverse), zero);
    if constexpr (kKind == LightRecord::Kind::cosine) {
      const Floats perArea = hn::Mul(away, hn::Min(hn::Mul(inverse, inverse), c.perClampDistance2));
      weight = hn::Mul(nl, perArea);
      solidAngle = hn::Mul(broadcast(footprint), perArea);
    } else {
      const Floats ramp = hn::MulAdd(away, light.coneScale, light.coneOffset);
      const Floats cone = hn::Min(hn::Max(ramp, zero), broadcast(1.0f));
      weight = hn::Mul(hn::Mul(cone, cone), hn::Div(nl, d2));
    }
    weight = hn::Min(weight, light.mostWeight);
  }
  lit = hn::AndNot(occluded, lit);
  if (hn::AllFalse(kTag, lit)) return;
  // Few lanes.
  const Mask isLarge = hn::Gt(solidAngle, broadcast(shared::kMostSolidAngle));
  if (!hn::AllFalse(kTag, isLarge)) {
    const Floats share = hn::Div(broadcast(shared::kMostSolidAngle), solidAngle);
    weight = hn::IfThenElse(isLarge, hn::Mul(weight, share), weight);
  }
  // Other lanes use a light above the surface with weight 0, to avoid a division by zero.
  addLobe<kSign>(p, light.units, hn::IfThenElseZero(lit, weight),
                 hn::IfThenElse(lit, nl, broadcast(1.0f)), lv, solidAngle, sum);
}

}  // namespace

template <typename Sum>
struct SpecularBlock<Sum>::Place {
  GlossyPoints points;
  SumsOf3<Sum> sum;
  SpecularUses uses;
  uint32_t leftOutBy;
};

template <typename Sum>
SpecularBlock<Sum>::SpecularBlock(const GBuffer& gbuffer, const vec3& eye,
                                  const SumConstants& constants, float leastRoughness)
    : gbuffer_(gbuffer), eye_(eye), constants_(constants), leastRoughness_(leastRoughness) {
  constants_.unitsPerIrradiance = 1.0f;
  places_.reserve(kMostSpecularParts);
}
template <typename Sum>
SpecularBlock<Sum>::~SpecularBlock() = default;

template <typename Sum>
void SpecularBlock<Sum>::add(size_t first, uint8_t lanes, std::span<const Gloss, kLanes> gloss,
                             const SpecularUses& uses, uint32_t leftOutBy) {
  places_.push_back(
      {pointsAt(gbuffer_, eye_, first, lanes, gloss, leastRoughness_), {}, uses, leftOutBy});
}

template <typename Sum>
template <LightRecord::Kind kKind, Sign kSign, typename UsesOf>
void SpecularBlock<Sum>::addKind(const SpecularLight& specular, const UsesOf& usesOf) {
  const LightRecord& record = specular.record;
  const SimdLight light(record, false, constants_);
  const SimdConstants c(constants_, record.resolution);
  for (Place& place : places_) {
    if (isLeftOut(place.leftOutBy, record.link)) continue;
    bool readsShadowMap = record.map != nullptr;
    const ShadowMode* uses = usesOf(place.uses);
    if (uses != nullptr && record.slot >= 0) {
      const ShadowMode use = uses[record.slot];
      if (use == ShadowMode::skip) continue;
      readsShadowMap = readsShadowMap && use != ShadowMode::add;
    }
    addSpecular<kKind, kSign>(place.points, light, specular.footprint, readsShadowMap, c,
                              place.sum);
  }
}

template <typename Sum>
template <Sign kSign, typename UsesOf>
void SpecularBlock<Sum>::addLight(const SpecularLight& light, const UsesOf& usesOf) {
  using Kind = LightRecord::Kind;
  switch (light.record.kind) {
    case Kind::cosine:
      return addKind<Kind::cosine, kSign>(light, usesOf);
    case Kind::uniform:
      return addKind<Kind::uniform, kSign>(light, usesOf);
    case Kind::directional:
      return addKind<Kind::directional, kSign>(light, usesOf);
  }
}

template <typename Sum>
void SpecularBlock<Sum>::add(std::span<const SpecularLight> lights) {
  for (const SpecularLight& light : lights)
    addLight<Sign::add>(light, [](const SpecularUses& uses) { return uses.now; });
}

template <typename Sum>
void SpecularBlock<Sum>::takeAway(std::span<const SpecularLight> lights) {
  for (const SpecularLight& light : lights)
    addLight<Sign::takeAway>(light, [](const SpecularUses& uses) { return uses.before; });
}

template <typename Sum>
void SpecularBlock<Sum>::changeUses(const SpecularLight& light) {
  const auto slot = static_cast<size_t>(light.record.slot);
  const std::vector<ShadowMode> skipped(slot + 1, ShadowMode::skip);
  const auto ifOther = [&](const SpecularUses& uses, const ShadowMode* which) {
    return uses.now[slot] != uses.before[slot] ? which : skipped.data();
  };
  addLight<Sign::takeAway>(light,
                           [&](const SpecularUses& uses) { return ifOther(uses, uses.before); });
  addLight<Sign::add>(light, [&](const SpecularUses& uses) { return ifOther(uses, uses.now); });
}

template <typename Sum>
void SpecularBlock<Sum>::read(size_t k, std::span<double, size_t{3} * kLanes> sums) const {
  const SumsOf3<Sum>& sum = places_[k].sum;
  sum.r.store(&sums[0]);
  sum.g.store(&sums[kLanes]);
  sum.b.store(&sums[size_t{2} * kLanes]);
}

template class SpecularBlock<ExactSum>;
template class SpecularBlock<FloatSum>;

}  // namespace lamplighter::cpu
