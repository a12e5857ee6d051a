#include "renderer/backends/cpu/specular_kernel.h"

#include "renderer/backends/cpu/wide_light.h"
#include "renderer/scene/light_linking.h"
#include "shaders/shared/vpl_speculars.h"

namespace lamplighter::cpu {
namespace {

// The points of a packet with their lobes.
struct Points {
  Vector3 position, shading, geometric, toEye;
  bool isFlat;
  Mask meant;
  Floats alpha2, nv;
  Vector3 straight;  // F0
  Floats grazing;    // F at 90°
};

Points pointsAt(const GBuffer& g, const vec3& from, size_t first, uint8_t lanes,
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
HWY_INLINE void addLobe(const Points& p, const Vector3& colour, Floats weight, Floats nl, Floats lv,
                        Floats solidAngle, Vector3& sum) {
  const Floats one = all(1.0f), half = all(0.5f);
  const Floats vh2 = hn::Max(hn::MulAdd(half, lv, half), all(1e-6f)), vh = hn::Sqrt(vh2);
  const Floats a2 = hn::Min(
      hn::Add(p.alpha2, hn::Div(hn::Mul(solidAngle, all(shared::kSpread / (4.0f * kPi))), vh)),
      one);
  const Floats both = hn::Add(nl, p.nv);
  const Floats nh2 = hn::Min(hn::Div(hn::Mul(both, both), hn::Mul(all(4.0f), vh2)), one);
  const Floats d = hn::MulAdd(nh2, hn::Sub(a2, one), one);
  const auto side = [&](Floats a, Floats b) {
    const Floats rest = hn::MulAdd(hn::Mul(b, b), hn::Sub(one, a2), a2);
    return hn::Mul(a, hn::Sqrt(rest));
  };
  const Floats masking = hn::Add(side(nl, p.nv), side(p.nv, nl));
  const Floats dv =
      hn::Div(hn::Mul(hn::Mul(a2, all(0.5f / kPi)), weight), hn::Mul(hn::Mul(d, d), masking));
  const Floats m = hn::Sub(one, vh), m2 = hn::Mul(m, m);
  const Floats grazing = hn::Mul(hn::Mul(m2, m2), m);
  const auto add = [&](Floats straight, Floats light, Floats& to) {
    const Floats f = hn::MulAdd(grazing, hn::Sub(p.grazing, straight), straight);
    to = hn::MulAdd(hn::Mul(dv, light), f, to);
  };
  add(p.straight.x, colour.x, sum.x);
  add(p.straight.y, colour.y, sum.y);
  add(p.straight.z, colour.z, sum.z);
}

template <LightRecord::Kind kKind>
HWY_INLINE void addSpecular(const Points& p, const SpecularLight& record, bool looksUp,
                            const SumConstants& constants, const WideConstants& c, Vector3& sum) {
  const WideLight light(record.record, false, constants);
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
    solidAngle = all(record.footprint);
    if (looksUp) occluded = directionalOccluded(light, c, q, geometric, facing);
  } else {
    const Floats z = dot(v, light.normal);
    const Floats s = hn::Neg(dot(p.shading, v));
    const Floats facing = p.isFlat ? s : hn::Neg(dot(geometric, v));
    lit =
        hn::And(hn::And(p.meant, hn::Gt(z, zero)), hn::And(hn::Gt(s, zero), hn::Gt(facing, zero)));
    if (hn::AllFalse(kTag, lit)) return;
    if (looksUp)
      occluded =
          hemisphereOccluded(light, c, v, hn::IfThenElse(lit, z, all(1.0f)), geometric, facing);
    const Floats d2 = hn::Max(dot(v, v), all(1e-12f));
    const Floats inverse = hn::Div(all(1.0f), hn::Sqrt(d2));
    nl = hn::Mul(s, inverse);
    lv = hn::Neg(hn::Mul(dot(v, p.toEye), inverse));
    // Cosine at the light. Behind it, in lanes that it does not reach, no lobe must be without end.
    const Floats away = hn::Max(hn::Mul(z, inverse), zero);
    if constexpr (kKind == LightRecord::Kind::cosine) {
      const Floats perArea = hn::Div(away, hn::Max(d2, c.clampDistance2));
      weight = hn::Mul(nl, perArea);
      solidAngle = hn::Mul(all(record.footprint), perArea);
    } else {
      const Floats ramp = hn::MulAdd(away, light.coneScale, light.coneOffset);
      const Floats cone = hn::Min(hn::Max(ramp, zero), all(1.0f));
      weight = hn::Mul(hn::Mul(cone, cone), hn::Div(nl, d2));
    }
    weight = hn::Min(weight, light.mostWeight);
  }
  lit = hn::AndNot(occluded, lit);
  if (hn::AllFalse(kTag, lit)) return;
  const Floats share =
      hn::Min(hn::Div(all(shared::kMostSolidAngle), hn::Max(solidAngle, all(1e-6f))), all(1.0f));
  // In the other lanes a light from above the surface, of weight nothing: no division by nothing.
  addLobe(p, light.units, hn::IfThenElseZero(lit, hn::Mul(weight, share)),
          hn::IfThenElse(lit, nl, all(1.0f)), lv, solidAngle, sum);
}

}  // namespace

void specularRadiance(const GBuffer& gbuffer, const vec3& eye, size_t first, uint8_t lanes,
                      std::span<const Gloss, kLanes> gloss, std::span<const SpecularLight> lights,
                      const LightUse* uses, uint32_t leftOutBy, const SumConstants& constants,
                      float leastRoughness, std::span<vec3, kLanes> out) {
  using Kind = LightRecord::Kind;
  const Points points = pointsAt(gbuffer, eye, first, lanes, gloss, leastRoughness);
  SumConstants ofLight = constants;
  ofLight.unitsPerIrradiance = 1.0f;
  const WideConstants wide(constants);
  Vector3 sum{hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag)};
  for (const SpecularLight& light : lights) {
    const LightRecord& record = light.record;
    if (isLeftOut(leftOutBy, record.link)) continue;
    bool looksUp = record.map != nullptr;
    if (uses != nullptr && record.slot >= 0) {
      const LightUse use = uses[record.slot];
      if (use == LightUse::skip) continue;
      looksUp = looksUp && use != LightUse::add;
    }
    switch (record.kind) {
      case Kind::cosine:
        addSpecular<Kind::cosine>(points, light, looksUp, ofLight, wide, sum);
        break;
      case Kind::uniform:
        addSpecular<Kind::uniform>(points, light, looksUp, ofLight, wide, sum);
        break;
      case Kind::directional:
        addSpecular<Kind::directional>(points, light, looksUp, ofLight, wide, sum);
        break;
    }
  }
  HWY_ALIGN float r[kLanes], g[kLanes], b[kLanes];
  hn::Store(sum.x, kTag, r);
  hn::Store(sum.y, kTag, g);
  hn::Store(sum.z, kTag, b);
  for (size_t lane = 0; lane < kLanes; ++lane)
    if ((lanes >> lane & 1) != 0) out[lane] = vec3(r[lane], g[lane], b[lane]);
}

}  // namespace lamplighter::cpu
