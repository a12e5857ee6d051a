// x86-64-v3 has no AES instructions, which Highway wants of its AVX2 target unless told otherwise.
#define HWY_DISABLE_PCLMUL_AES 1

#include "renderer/backends/cpu/light_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <hwy/highway.h>

#include "shaders/shared/vpl_shading.h"

// shaders/shared/vpl_shading.h is the definition, with the reasons; this is the same, eight points
// at a time, with multiply-adds fused where written so.
namespace lamplighter::cpu {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::FixedTag<float, kLanes>;
using IntTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;
constexpr Tag kTag;

// A light's weight [1/m²] is bounded, so that sums can be: of a punctual light at 6 cm, where it
// has no surface to be so near to; of one that stands for a surface it is the clamp that counts.
constexpr float kMostUniformWeight = 256.0f;
constexpr float kMostCosineWeight = 4096.0f;
constexpr float kMostSum = 0x1p30f;  // units

float mostWeight(LightRecord::Kind kind, float clampDistance2) {
  switch (kind) {
    case LightRecord::Kind::cosine:
      return std::min(1.0f / clampDistance2, kMostCosineWeight);
    case LightRecord::Kind::uniform:
      return kMostUniformWeight;
    case LightRecord::Kind::directional:
      break;
  }
  return 1.0f;
}

struct Vector3 {
  Floats x, y, z;
};

using Ints = hn::Vec<IntTag>;

// Highway's own conversions also put right what is out of range, which nothing is here.
HWY_INLINE Ints roundToInts(Floats v) {
#if HWY_TARGET == HWY_AVX2
  return Ints{_mm256_cvtps_epi32(v.raw)};
#else
  return hn::NearestInt(v);
#endif
}
HWY_INLINE Ints truncateToInts(Floats v) {
#if HWY_TARGET == HWY_AVX2
  return Ints{_mm256_cvttps_epi32(v.raw)};
#else
  return hn::ConvertTo(IntTag(), v);
#endif
}

HWY_INLINE Floats all(float v) { return hn::Set(kTag, v); }
HWY_INLINE Floats dot(const Vector3& a, const Vector3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
// Three arrays; as pointers of its own, which stores elsewhere don't change.
struct Vectors {
  Vectors(const std::vector<float>& vx, const std::vector<float>& vy, const std::vector<float>& vz)
      : x(vx.data()), y(vy.data()), z(vz.data()) {}
  Vector3 at(size_t i) const {
    return {hn::LoadU(kTag, x + i), hn::LoadU(kTag, y + i), hn::LoadU(kTag, z + i)};
  }
  const float* HWY_RESTRICT x;
  const float* HWY_RESTRICT y;
  const float* HWY_RESTRICT z;
};

HWY_INLINE Vector3 all(const vec3& v) { return {all(v.x), all(v.y), all(v.z)}; }

// The light in every lane, so that the loop over pixels takes it as vector operands from the stack.
struct WideLight {
  WideLight(const LightRecord& light, bool isNegative, const SumConstants& c)
      : map(light.map),
        position(all(light.position)),
        normal(all(light.normal)),
        tangent(all(light.tangent)),
        bitangent(all(light.bitangent)),
        units(all((isNegative ? -c.unitsPerIrradiance : c.unitsPerIrradiance) * light.intensity)),
        mostWeight(all(cpu::mostWeight(light.kind, c.clampDistance2))),
        coneScale(all(light.coneScale)),
        coneOffset(all(light.coneOffset)),
        side(all(light.side)),
        inverseSide(all(1.0f / light.side)),
        depth(all(2.0f * light.radius)),
        deepest(all(-light.radius - c.bias * light.side)) {}

  const float* map;
  Vector3 position, normal, tangent, bitangent;
  Vector3 units;  // intensity, in units of the sums
  Floats mostWeight;
  Floats coneScale, coneOffset;
  Floats side, inverseSide, depth, deepest;  // directional
};

// Numbers of the map's grid and of the test in every lane.
struct WideConstants {
  explicit WideConstants(const SumConstants& c)
      : resolution(all(static_cast<float>(c.resolution))),
        middle(all(0.5f * static_cast<float>(c.resolution))),
        half(all(0.5f * static_cast<float>(c.resolution) * (1.0f - 0x1p-21f))),
        lastTexel(hn::Set(hn::RebindToUnsigned<Tag>(),
                          static_cast<uint32_t>(c.resolution * c.resolution - 1))),
        step(all(2.0f / static_cast<float>(c.resolution))),
        first(all(1.0f / static_cast<float>(c.resolution) - 1.0f)),
        beforePlane(all(1.0f + c.bias)),
        beforePoint(all(1.0f + c.bias + shared::kCornerTexels / static_cast<float>(c.resolution))),
        clampDistance2(all(c.clampDistance2)) {}

  Floats resolution, middle, half;
  hn::Vec<hn::RebindToUnsigned<Tag>> lastTexel;
  Floats step, first;
  Floats beforePlane, beforePoint;
  Floats clampDistance2;
};

// The texel's column or row of a square coordinate in [-1, 1]; `half` is a little less than it is,
// so that no rounding leads out of the map.
HWY_INLINE Floats texelOf(Floats s, const WideConstants& c) {
  return hn::Floor(hn::MulAdd(s, c.half, c.middle));
}
HWY_INLINE Floats centreOf(Floats texel, const WideConstants& c) {
  return hn::MulAdd(texel, c.step, c.first);
}

// The index of a texel is a whole number that a float holds: maps have at most 1024² texels. The
// bound is for coordinates that are no numbers.
HWY_INLINE Floats fetch(const float* map, Floats s, Floats t, const WideConstants& c) {
  const Ints texel = truncateToInts(hn::MulAdd(t, c.resolution, s));
  const hn::RebindToUnsigned<Tag> unsignedTag;
  const auto bounded = hn::Min(hn::BitCast(unsignedTag, texel), c.lastTexel);
  return hn::GatherIndex(kTag, map, hn::BitCast(IntTag(), bounded));
}

// v: from the light to the point; z: its height over the light's plane, > 0.
HWY_INLINE Mask hemisphereOccluded(const WideLight& light, const WideConstants& c, const Vector3& v,
                                   Floats z, const Vector3& geometric, Floats facing) {
  const Floats x = dot(v, light.tangent), y = dot(v, light.bitangent);
  const Floats w = hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), z);
  const Floats inverse = hn::Div(all(1.0f), w);
  const Floats s = texelOf(hn::Mul(hn::Add(x, y), inverse), c);
  const Floats t = texelOf(hn::Mul(hn::Sub(x, y), inverse), c);
  const Floats stored = fetch(light.map, s, t, c);
  const Mask beforePoint = hn::Gt(hn::Mul(stored, w), c.beforePoint);
  // Mostly nothing is; then the plane need not be asked.
  if (hn::AllFalse(kTag, beforePoint)) return beforePoint;
  const Floats cs = centreOf(s, c), ct = centreOf(t, c);
  const Floats ex = hn::Mul(hn::Add(cs, ct), all(0.5f));
  const Floats ey = hn::Mul(hn::Sub(cs, ct), all(0.5f));
  const Floats ez = hn::Sub(all(1.0f), hn::Add(hn::Abs(ex), hn::Abs(ey)));
  const Floats plane = hn::MulAdd(
      dot(geometric, light.tangent), ex,
      hn::MulAdd(dot(geometric, light.bitangent), ey, hn::Mul(dot(geometric, light.normal), ez)));
  // facing = −n·v > 0
  const Mask beforePlane =
      hn::Gt(hn::MulAdd(stored, facing, hn::Mul(c.beforePlane, plane)), hn::Zero(kTag));
  return hn::And(beforePoint, beforePlane);
}

// q: the point in the light's frame.
HWY_INLINE Mask directionalOccluded(const WideLight& light, const WideConstants& c,
                                    const Vector3& q, const Vector3& geometric, Floats facing) {
  // Within the square in the lanes that count.
  const auto inSquare = [](Floats v) { return hn::Max(hn::Min(v, all(1.0f)), all(-1.0f)); };
  const Floats s = texelOf(inSquare(hn::Mul(q.x, light.inverseSide)), c);
  const Floats t = texelOf(inSquare(hn::Mul(q.y, light.inverseSide)), c);
  const Floats stored = fetch(light.map, s, t, c);
  const Floats above = hn::Sub(hn::MulAdd(stored, light.depth, light.deepest), q.z);
  const Floats dx = hn::MulSub(centreOf(s, c), light.side, q.x);
  const Floats dy = hn::MulSub(centreOf(t, c), light.side, q.y);
  const Floats slope =
      hn::MulAdd(dot(geometric, light.tangent), dx, hn::Mul(dot(geometric, light.bitangent), dy));
  const Mask beforePoint = hn::Gt(above, hn::Zero(kTag));
  const Mask beforePlane = hn::Gt(hn::MulAdd(above, facing, slope), hn::Zero(kTag));
  return hn::And(beforePoint, beforePlane);
}

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
