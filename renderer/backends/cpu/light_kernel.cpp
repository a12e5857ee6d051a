#include "renderer/backends/cpu/light_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "renderer/backends/cpu/wide_light.h"

namespace lamplighter::cpu {
namespace {

constexpr float kMostSum = 0x1p30f;  // units

// Where the sums of a packet are.
class WideSums {
 public:
  explicit WideSums(FixedSums& sums) : r_(sums.r.data()), g_(sums.g.data()), b_(sums.b.data()) {}
  HWY_INLINE void add(size_t i, Floats weight, const Vector3& units) const {
    add(r_ + i, hn::Mul(weight, units.x));
    add(g_ + i, hn::Mul(weight, units.y));
    add(b_ + i, hn::Mul(weight, units.z));
  }

 private:
  // Rounding to nearest is the same on both sides of zero, so that taking away undoes adding.
  static HWY_INLINE void add(int32_t* to, Floats share) {
    hn::StoreU(hn::Add(hn::LoadU(IntTag(), to), roundToInts(share)), IntTag(), to);
  }

  int32_t* HWY_RESTRICT r_;
  int32_t* HWY_RESTRICT g_;
  int32_t* HWY_RESTRICT b_;
};

// What it gives where it arrives [1/m² of its intensity]. v: from the light to the point; z: its
// height over the light's plane; s: −n·v, or n·(the light's direction) of a parallel one.
template <LightRecord::Kind kKind>
HWY_INLINE Floats weightOf(const WideLight& light, const WideConstants& c, const Vector3& v,
                           Floats z, Floats s) {
  if constexpr (kKind == LightRecord::Kind::directional) {
    return s;
  } else {
    const Floats d2 = dot(v, v);
    if constexpr (kKind == LightRecord::Kind::cosine)
      return hn::Div(hn::Mul(s, z), hn::Mul(d2, hn::Max(d2, c.clampDistance2)));
    const Floats d = hn::Sqrt(d2);
    const Floats ramp = hn::MulAdd(hn::Div(z, d), light.coneScale, light.coneOffset);
    const Floats cone = hn::Min(hn::Max(ramp, hn::Zero(kTag)), all(1.0f));
    return hn::Mul(hn::Mul(cone, cone), hn::Div(s, hn::Mul(d2, d)));
  }
}

HWY_INLINE Vector3 fromLight(const Vector3& p, const WideLight& light) {
  return {hn::Sub(p.x, light.position.x), hn::Sub(p.y, light.position.y),
          hn::Sub(p.z, light.position.z)};
}

// kUse: add, addShadowed or takeShadow. lit: null, or by packet.
template <LightRecord::Kind kKind, LightUse kUse>
void addLight(const GBuffer& g, const PacketList& packets, bool isNegative,
              const LightRecord& record, const SumConstants& constants, uint8_t* lit,
              FixedSums& fixedSums) {
  constexpr bool kLooksUp = kUse != LightUse::add;
  const WideLight light(record, isNegative, constants);
  const WideConstants c(constants);
  const WideSums sums(fixedSums);
  const Floats zero = hn::Zero(kTag);
  const Vectors positions(g.px, g.py, g.pz), shadings(g.sx, g.sy, g.sz),
      geometrics(g.gx, g.gy, g.gz);
  for (size_t k = 0; k < packets.count(); ++k) {
    const size_t i = packets.first(k);
    if (kLooksUp && lit != nullptr) lit[i / kLanes] &= static_cast<uint8_t>(~*packets.lanes(k));
    const Mask meant = hn::LoadMaskBits(kTag, packets.lanes(k));
    const Vector3 v = fromLight(positions.at(i), light);
    const Vector3 shading = shadings.at(i);
    const bool isFlat = g.isFlat[i / kLanes] != 0;
    const Vector3 geometric = isFlat ? shading : geometrics.at(i);
    Floats s, z = zero;
    Mask reached, occluded = hn::MaskFromVec(zero);
    if constexpr (kKind == LightRecord::Kind::directional) {
      const Vector3 q{dot(v, light.tangent), dot(v, light.bitangent), dot(v, light.normal)};
      const Floats facing = dot(geometric, light.normal);
      s = dot(shading, light.normal);
      const Floats side = light.side;
      const Mask within = hn::And(hn::And(hn::Ge(q.x, hn::Neg(side)), hn::Lt(q.x, side)),
                                  hn::And(hn::Ge(q.y, hn::Neg(side)), hn::Lt(q.y, side)));
      reached = hn::And(hn::And(meant, within), hn::And(hn::Gt(s, zero), hn::Gt(facing, zero)));
      if (hn::AllFalse(kTag, reached)) continue;
      if constexpr (kLooksUp) occluded = directionalOccluded(light, c, q, geometric, facing);
    } else {
      z = dot(v, light.normal);
      s = hn::Neg(dot(shading, v));
      const Floats facing = isFlat ? s : hn::Neg(dot(geometric, v));
      reached =
          hn::And(hn::And(meant, hn::Gt(z, zero)), hn::And(hn::Gt(s, zero), hn::Gt(facing, zero)));
      if (hn::AllFalse(kTag, reached)) continue;
      // A height above zero keeps 1/w finite in the lanes that the light does not reach.
      if constexpr (kLooksUp)
        occluded = hemisphereOccluded(light, c, v, hn::IfThenElse(reached, z, all(1.0f)), geometric,
                                      facing);
    }
    if constexpr (kUse == LightUse::addShadowed) reached = hn::AndNot(occluded, reached);
    if constexpr (kUse == LightUse::takeShadow) reached = hn::And(occluded, reached);
    if constexpr (kLooksUp) {
      if (hn::AllFalse(kTag, reached)) continue;
      if (lit != nullptr) {
        uint8_t lanes[8];
        hn::StoreMaskBits(kTag, reached, lanes);
        lit[i / kLanes] |= lanes[0];
      }
    }
    const Floats weight = hn::IfThenElseZero(reached, weightOf<kKind>(light, c, v, z, s));
    sums.add(i, hn::Min(weight, light.mostWeight), light.units);
  }
}

// Takes away what a light with a shadow map gave: which lanes these are is known.
template <LightRecord::Kind kKind>
void takeAwayLit(const GBuffer& g, const PacketList& packets, bool isNegative,
                 const LightRecord& record, const SumConstants& constants, const uint8_t* lit,
                 FixedSums& fixedSums) {
  const WideLight light(record, isNegative, constants);
  const WideConstants c(constants);
  const WideSums sums(fixedSums);
  const Vectors positions(g.px, g.py, g.pz), shadings(g.sx, g.sy, g.sz);
  // Which packets there are is found first, without a branch that nobody can foretell.
  uint16_t some[PacketList::kMost];
  size_t count = 0;
  for (size_t k = 0; k < packets.count(); ++k) {
    some[count] = static_cast<uint16_t>(k);
    count += (lit[packets.first(k) / kLanes] & *packets.lanes(k)) != 0 ? 1 : 0;
  }
  for (size_t n = 0; n < count; ++n) {
    const size_t k = some[n], i = packets.first(k);
    const auto lanes = static_cast<uint8_t>(lit[i / kLanes] & *packets.lanes(k));
    const Vector3 v = fromLight(positions.at(i), light);
    const Vector3 shading = shadings.at(i);
    Floats s, z = hn::Zero(kTag);
    if constexpr (kKind == LightRecord::Kind::directional) {
      s = dot(shading, light.normal);
    } else {
      z = dot(v, light.normal);
      s = hn::Neg(dot(shading, v));
    }
    const Floats weight =
        hn::IfThenElseZero(hn::LoadMaskBits(kTag, &lanes), weightOf<kKind>(light, c, v, z, s));
    sums.add(i, hn::Min(weight, light.mostWeight), light.units);
  }
}

template <LightRecord::Kind kKind>
void addLight(const GBuffer& gbuffer, const PacketList& packets, LightUse use, Sign sign,
              const LightRecord& light, const SumConstants& constants, uint8_t* lit,
              FixedSums& sums) {
  const bool isNegative = (sign == Sign::takeAway) != (use == LightUse::takeShadow);
  if (sign == Sign::takeAway && use != LightUse::add && lit != nullptr)
    return takeAwayLit<kKind>(gbuffer, packets, isNegative, light, constants, lit, sums);
  switch (use) {
    case LightUse::skip:
      break;
    case LightUse::add:
      return addLight<kKind, LightUse::add>(gbuffer, packets, isNegative, light, constants, lit,
                                            sums);
    case LightUse::addShadowed:
      return addLight<kKind, LightUse::addShadowed>(gbuffer, packets, isNegative, light, constants,
                                                    lit, sums);
    case LightUse::takeShadow:
      return addLight<kKind, LightUse::takeShadow>(gbuffer, packets, isNegative, light, constants,
                                                   lit, sums);
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
              const LightRecord& light, const SumConstants& constants, uint8_t* lit,
              FixedSums& sums) {
  static_assert(hn::MaxLanes(kTag) == kLanes);
  if (packets.count() == 0) return;
  const auto add = [&]<LightRecord::Kind kKind>() {
    addLight<kKind>(gbuffer, packets, use, sign, light, constants, lit, sums);
  };
  switch (light.kind) {
    case LightRecord::Kind::cosine:
      return add.operator()<LightRecord::Kind::cosine>();
    case LightRecord::Kind::uniform:
      return add.operator()<LightRecord::Kind::uniform>();
    case LightRecord::Kind::directional:
      return add.operator()<LightRecord::Kind::directional>();
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
