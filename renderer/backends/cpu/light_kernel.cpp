#include "renderer/backends/cpu/light_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "renderer/backends/cpu/wide_light.h"

namespace lamplighter::cpu {
namespace {

constexpr float kMostSum = 0x1p30f;  // units

// kUse: add, addShadowed or takeShadow.
template <LightRecord::Kind kKind, LightUse kUse>
void addLight(const GBuffer& g, const PacketList& packets, Sign sign, const LightRecord& record,
              const SumConstants& constants, FixedSums& sums) {
  constexpr bool kLooksUp = kUse != LightUse::add;
  const bool isNegative = (sign == Sign::takeAway) != (kUse == LightUse::takeShadow);
  const WideLight light(record, isNegative, constants);
  const WideConstants c(constants);
  const Floats zero = hn::Zero(kTag);
  const Vectors positions(g.px, g.py, g.pz), shadings(g.sx, g.sy, g.sz),
      geometrics(g.gx, g.gy, g.gz);
  int32_t* HWY_RESTRICT red = sums.r.data();
  int32_t* HWY_RESTRICT green = sums.g.data();
  int32_t* HWY_RESTRICT blue = sums.b.data();
  for (size_t k = 0; k < packets.count(); ++k) {
    const size_t i = packets.first(k);
    const Mask meant = hn::LoadMaskBits(kTag, packets.lanes(k));
    const Vector3 p = positions.at(i);
    const Vector3 v{hn::Sub(p.x, light.position.x), hn::Sub(p.y, light.position.y),
                    hn::Sub(p.z, light.position.z)};
    const Vector3 shading = shadings.at(i);
    const bool isFlat = g.isFlat[i / kLanes] != 0;
    const Vector3 geometric = isFlat ? shading : geometrics.at(i);
    Floats weight;
    Mask occluded = hn::MaskFromVec(hn::Zero(kTag));
    if constexpr (kKind == LightRecord::Kind::directional) {
      const Vector3 q{dot(v, light.tangent), dot(v, light.bitangent), dot(v, light.normal)};
      const Floats s = dot(shading, light.normal), facing = dot(geometric, light.normal);
      const Floats side = light.side;
      const Mask within = hn::And(hn::And(hn::Ge(q.x, hn::Neg(side)), hn::Lt(q.x, side)),
                                  hn::And(hn::Ge(q.y, hn::Neg(side)), hn::Lt(q.y, side)));
      const Mask lit =
          hn::And(hn::And(meant, within), hn::And(hn::Gt(s, zero), hn::Gt(facing, zero)));
      if (hn::AllFalse(kTag, lit)) continue;
      weight = hn::IfThenElseZero(lit, s);
      if constexpr (kLooksUp) occluded = directionalOccluded(light, c, q, geometric, facing);
    } else {
      const Floats z = dot(v, light.normal);
      const Floats s = hn::Neg(dot(shading, v));
      const Floats facing = isFlat ? s : hn::Neg(dot(geometric, v));
      const Mask lit =
          hn::And(hn::And(meant, hn::Gt(z, zero)), hn::And(hn::Gt(s, zero), hn::Gt(facing, zero)));
      if (hn::AllFalse(kTag, lit)) continue;
      // A height above zero keeps 1/w finite in the lanes that the light does not reach.
      if constexpr (kLooksUp)
        occluded =
            hemisphereOccluded(light, c, v, hn::IfThenElse(lit, z, all(1.0f)), geometric, facing);
      if constexpr (kUse == LightUse::takeShadow)
        if (hn::AllFalse(kTag, hn::And(lit, occluded))) continue;
      const Floats d2 = dot(v, v);
      if constexpr (kKind == LightRecord::Kind::cosine) {
        const Floats bounded = hn::Max(d2, c.clampDistance2);
        weight = hn::Div(hn::Mul(s, z), hn::Mul(d2, bounded));
      } else {
        const Floats d = hn::Sqrt(d2);
        const Floats ramp = hn::MulAdd(hn::Div(z, d), light.coneScale, light.coneOffset);
        const Floats cone = hn::Min(hn::Max(ramp, zero), all(1.0f));
        weight = hn::Mul(hn::Mul(cone, cone), hn::Div(s, hn::Mul(d2, d)));
      }
      weight = hn::IfThenElseZero(lit, weight);
    }
    weight = hn::Min(weight, light.mostWeight);
    if constexpr (kUse == LightUse::addShadowed) weight = hn::IfThenZeroElse(occluded, weight);
    if constexpr (kUse == LightUse::takeShadow) weight = hn::IfThenElseZero(occluded, weight);
    // Rounding to nearest is the same on both sides of zero, so that taking away undoes adding.
    const auto add = [&](int32_t* to, Floats units) {
      const Ints share = roundToInts(hn::Mul(weight, units));
      hn::StoreU(hn::Add(hn::LoadU(IntTag(), to), share), IntTag(), to);
    };
    add(red + i, light.units.x);
    add(green + i, light.units.y);
    add(blue + i, light.units.z);
  }
}

template <LightUse kUse>
void addLight(const GBuffer& gbuffer, const PacketList& packets, Sign sign,
              const LightRecord& light, const SumConstants& constants, FixedSums& sums) {
  switch (light.kind) {
    case LightRecord::Kind::cosine:
      return addLight<LightRecord::Kind::cosine, kUse>(gbuffer, packets, sign, light, constants,
                                                       sums);
    case LightRecord::Kind::uniform:
      return addLight<LightRecord::Kind::uniform, kUse>(gbuffer, packets, sign, light, constants,
                                                        sums);
    case LightRecord::Kind::directional:
      return addLight<LightRecord::Kind::directional, kUse>(gbuffer, packets, sign, light,
                                                            constants, sums);
  }
}

}  // namespace

LightRecord makeLightRecord(const shared::Vpl& vpl, const float* map) {
  LightRecord light;
  light.kind = vpl.position.w == shared::kVplCosine    ? LightRecord::Kind::cosine
               : vpl.position.w == shared::kVplUniform ? LightRecord::Kind::uniform
                                                       : LightRecord::Kind::directional;
  light.map = map;
  light.slot = static_cast<int>(vpl.intensity.w);
  light.position = vec3(vpl.position);
  light.normal = vec3(vpl.normal);
  light.tangent = vec3(vpl.tangent);
  light.bitangent = glm::cross(light.normal, light.tangent);
  light.intensity = vec3(vpl.intensity);
  light.coneScale = light.radius = vpl.normal.w;
  light.coneOffset = light.side = vpl.tangent.w;
  light.link = static_cast<uint32_t>(vpl.footprint.y);
  return light;
}

void addLight(const GBuffer& gbuffer, const PacketList& packets, LightUse use, Sign sign,
              const LightRecord& light, const SumConstants& constants, FixedSums& sums) {
  static_assert(hn::MaxLanes(kTag) == kLanes);
  if (packets.count() == 0) return;
  switch (use) {
    case LightUse::skip:
      break;
    case LightUse::add:
      return addLight<LightUse::add>(gbuffer, packets, sign, light, constants, sums);
    case LightUse::addShadowed:
      return addLight<LightUse::addShadowed>(gbuffer, packets, sign, light, constants, sums);
    case LightUse::takeShadow:
      return addLight<LightUse::takeShadow>(gbuffer, packets, sign, light, constants, sums);
  }
}

// A sum is at most that of all intensities × the weight that each can have. A parallel light's
// squares lie side by side, so that one of each direction counts.
float unitsPerIrradiance(std::span<const LightRecord> lights, float clampDistance2) {
  float most = 0.0f;
  std::map<std::array<float, 3>, float> parallel;
  for (const LightRecord& light : lights) {
    const float brightest = std::max({light.intensity.r, light.intensity.g, light.intensity.b});
    if (light.kind != LightRecord::Kind::directional) {
      most += brightest * mostWeight(light.kind, clampDistance2);
      continue;
    }
    float& square = parallel[{light.normal.x, light.normal.y, light.normal.z}];
    square = std::max(square, brightest);
  }
  for (const auto& [direction, square] : parallel) most += square;
  if (!(most > 0.0f) || !std::isfinite(most)) return 1.0f;
  return std::ldexp(1.0f, std::clamp(std::ilogb(kMostSum / most), -100, 100));
}

}  // namespace lamplighter::cpu
