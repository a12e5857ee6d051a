#include "renderer/backends/cpu/irradiance/light_kernel.h"

#include <bit>

#include "renderer/backends/cpu/irradiance/simd_light.h"

namespace lamplighter::cpu {
namespace {

constexpr size_t kBytes = 32;
constexpr hn::FixedTag<uint8_t, kBytes> kByteTag;
static_assert(PacketBlock::kMost % kBytes == 0);

HWY_INLINE Vector3 load(const float (&from)[3][kLanes]) {
  return {hn::Load(kTag, from[0]), hn::Load(kTag, from[1]), hn::Load(kTag, from[2])};
}

// Rounding to nearest is symmetric about zero, so subtracting exactly reverses adding.
HWY_INLINE void addTo(int32_t (&sum)[3][kLanes], Floats weight, const Vector3& units) {
  const auto add = [&](int32_t* to, Floats share) {
    hn::Store(hn::Add(hn::Load(IntTag(), to), roundToInts(share)), IntTag(), to);
  };
  add(sum[0], hn::Mul(weight, units.x));
  add(sum[1], hn::Mul(weight, units.y));
  add(sum[2], hn::Mul(weight, units.z));
}

// The same for sums with a second part. Negating the units negates both parts exactly.
HWY_INLINE void addTo(int32_t (&sum)[3][kLanes], int32_t (&fine)[3][kLanes], Floats weight,
                      const Vector3& units) {
  const auto add = [&](int32_t* to, int32_t* rest, Floats share) {
    const Ints whole = roundToInts(share);
    hn::Store(hn::Add(hn::Load(IntTag(), to), whole), IntTag(), to);
    const Floats left = hn::Sub(share, hn::ConvertTo(kTag, whole));
    const Ints parts = roundToInts(hn::Mul(left, broadcast(FixedSums::kFinePerUnit)));
    hn::Store(hn::Add(hn::Load(IntTag(), rest), parts), IntTag(), rest);
  };
  add(sum[0], fine[0], hn::Mul(weight, units.x));
  add(sum[1], fine[1], hn::Mul(weight, units.y));
  add(sum[2], fine[2], hn::Mul(weight, units.z));
}

// Adds to the sums of packet i of the block.
template <bool kFine>
HWY_INLINE void addTo(PacketBlock& block, size_t i, Floats weight, const Vector3& units) {
  if constexpr (kFine)
    addTo(block.at(i).sum, block.fine(i), weight, units);
  else
    addTo(block.at(i).sum, weight, units);
}

// Replaces the old contribution by the new one.
HWY_INLINE void replaceIn(int32_t (&sum)[3][kLanes], Floats weight, const Vector3& now,
                          const Vector3& before) {
  const auto replace = [&](int32_t* to, Floats is, Floats was) {
    const Ints more = hn::Sub(roundToInts(hn::Mul(weight, is)), roundToInts(hn::Mul(weight, was)));
    hn::Store(hn::Add(hn::Load(IntTag(), to), more), IntTag(), to);
  };
  replace(sum[0], now.x, before.x);
  replace(sum[1], now.y, before.y);
  replace(sum[2], now.z, before.z);
}

template <bool kFine>
HWY_INLINE void replaceIn(PacketBlock& block, size_t i, Floats weight, const Vector3& now,
                          const Vector3& before) {
  if constexpr (kFine) {
    const auto negative = [](Floats v) { return hn::Neg(v); };
    addTo(block.at(i).sum, block.fine(i), weight, now);
    addTo(block.at(i).sum, block.fine(i), weight,
          Vector3{negative(before.x), negative(before.y), negative(before.z)});
  } else {
    replaceIn(block.at(i).sum, weight, now, before);
  }
}

// The unshadowed irradiance [1/m² of its intensity]. v: from the light to the point; z: its height
// over the light's plane; s: −n·v, or n·(direction of the light) for a directional one.
template <LightRecord::Kind kKind>
HWY_INLINE Floats weightOf(const SimdLight& light, const SimdConstants& c, const Vector3& v,
                           Floats z, Floats s) {
  if constexpr (kKind == LightRecord::Kind::directional) {
    return s;
  } else {
    const Floats d2 = dot(v, v);
    if constexpr (kKind == LightRecord::Kind::cosine)
      return hn::Div(hn::Mul(s, z), hn::Mul(d2, hn::Max(d2, c.clampDistance2)));
    const Floats d = hn::Sqrt(d2);
    const Floats ramp = hn::MulAdd(hn::Div(z, d), light.coneScale, light.coneOffset);
    const Floats cone = hn::Min(hn::Max(ramp, hn::Zero(kTag)), broadcast(1.0f));
    return hn::Mul(hn::Mul(cone, cone), hn::Div(s, hn::Mul(d2, d)));
  }
}

HWY_INLINE Vector3 loadNormals(const float* from) {
  return {hn::LoadU(kTag, from), hn::LoadU(kTag, from + kLanes),
          hn::LoadU(kTag, from + size_t{2} * kLanes)};
}

HWY_INLINE Vector3 fromLight(const Vector3& p, const SimdLight& light) {
  return {hn::Sub(p.x, light.position.x), hn::Sub(p.y, light.position.y),
          hn::Sub(p.z, light.position.z)};
}

// kUse: add, addShadowed or subtractShadow. For subtractShadow it only finds the lanes, without
// branches: half of the packets of a partly hidden patch have some, so a branch would often be
// mispredicted. addMasked() then sums them.
template <LightRecord::Kind kKind, ShadowMode kUse, bool kFine>
void addLight(PacketBlock& block, const PacketList& packets, bool isNegative,
              const LightRecord& record, const SumConstants& constants, ShadowMasks& lit) {
  constexpr bool kLooksUp = kUse != ShadowMode::add, kSums = kUse != ShadowMode::subtractShadow;
  const SimdLight light(record, isNegative, constants);
  const SimdConstants c(constants, record.resolution);
  const Floats zero = hn::Zero(kTag);
  // Normal of the packet's plane in the light's frame; most packets have the plane of the previous
  // one.
  Vector3 normal{zero, zero, zero};
  size_t plane = PacketBlock::kMost;
  for (size_t k = 0; k < packets.count(); ++k) {
    const size_t i = packets.packet(k);
    PacketBlock::Packet& packet = block.at(i);
    if constexpr (kLooksUp) lit[k] = 0;
    const Mask meant = hn::LoadMaskBits(kTag, packets.lanes(k));
    const Vector3 v = fromLight(load(packet.position), light);
    const Vector3 shading = load(packet.shading);
    const float* normals = block.geometric(i);
    const bool isFlat = normals == nullptr;
    const Vector3 geometric = isFlat ? shading : loadNormals(normals);
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
      if (kSums && hn::AllFalse(kTag, reached)) continue;
      if constexpr (kLooksUp) occluded = directionalOccluded(light, c, q, geometric, facing);
    } else {
      z = dot(v, light.normal);
      s = hn::Neg(dot(shading, v));
      const Floats facing = isFlat ? s : hn::Neg(dot(geometric, v));
      reached =
          hn::And(hn::And(meant, hn::Gt(z, zero)), hn::And(hn::Gt(s, zero), hn::Gt(facing, zero)));
      if (kSums && hn::AllFalse(kTag, reached)) continue;
      // A positive height keeps 1/w finite in lanes that the light does not reach.
      if constexpr (kLooksUp)
        occluded = hemisphereOccluded<!kSums>(
            light, c, v, hn::IfThenElse(reached, z, broadcast(1.0f)),
            [&]() -> const Vector3& {
              if (block.plane(i) != plane) normal = inFrameOf(light, geometric);
              plane = block.plane(i);
              return normal;
            },
            facing);
    }
    if constexpr (kUse == ShadowMode::addShadowed) reached = hn::AndNot(occluded, reached);
    if constexpr (kUse == ShadowMode::subtractShadow) reached = hn::And(occluded, reached);
    if constexpr (kLooksUp) lit[k] = static_cast<uint8_t>(bitsOf(reached));
    if constexpr (kSums) {
      const Floats weight = hn::IfThenElseZero(reached, weightOf<kKind>(light, c, v, z, s));
      addTo<kFine>(block, i, hn::Min(weight, light.mostWeight), light.units);
    }
  }
}

// Calls add(i, weight) for packets i of the block, with the weights of the lanes.
template <LightRecord::Kind kKind, typename F>
void forEachLit(PacketBlock& block, const PacketList& packets, const SimdLight& light,
                const SumConstants& constants, const ShadowMasks& lit, F&& add) {
  const SimdConstants c(constants, 1);  // no map is read
  // First finds the packets with lanes, because a branch per packet would be unpredictable.
  std::array<uint8_t, PacketBlock::kMost> some;
  size_t count = 0;
  for (size_t k = 0; k < packets.count(); ++k) {
    some[count] = static_cast<uint8_t>(k);
    count += lit[k] != 0 ? 1 : 0;
  }
  for (size_t n = 0; n < count; ++n) {
    const size_t k = some[n], i = packets.packet(k);
    const PacketBlock::Packet& packet = block.at(i);
    const Vector3 v = fromLight(load(packet.position), light);
    const Vector3 shading = load(packet.shading);
    Floats s, z = hn::Zero(kTag);
    if constexpr (kKind == LightRecord::Kind::directional) {
      s = dot(shading, light.normal);
    } else {
      z = dot(v, light.normal);
      s = hn::Neg(dot(shading, v));
    }
    const Floats weight =
        hn::IfThenElseZero(hn::LoadMaskBits(kTag, &lit[k]), weightOf<kKind>(light, c, v, z, s));
    add(i, hn::Min(weight, light.mostWeight));
  }
}

template <LightRecord::Kind kKind, bool kFine>
void addMasked(PacketBlock& block, const PacketList& packets, bool isNegative,
               const LightRecord& record, const SumConstants& constants, const ShadowMasks& lit) {
  const SimdLight light(record, isNegative, constants);
  forEachLit<kKind>(block, packets, light, constants, lit,
                    [&](size_t i, Floats weight) { addTo<kFine>(block, i, weight, light.units); });
}

bool isNegative(ShadowMode use, Sign sign) {
  return (sign == Sign::takeAway) != (use == ShadowMode::subtractShadow);
}

template <LightRecord::Kind kKind, bool kFine>
void addLight(PacketBlock& block, const PacketList& packets, ShadowMode use, Sign sign,
              const LightRecord& light, const SumConstants& constants, ShadowMasks& lit) {
  const bool negative = isNegative(use, sign);
  switch (use) {
    case ShadowMode::skip:
      break;
    case ShadowMode::add:
      return addLight<kKind, ShadowMode::add, kFine>(block, packets, negative, light, constants,
                                                     lit);
    case ShadowMode::addShadowed:
      return addLight<kKind, ShadowMode::addShadowed, kFine>(block, packets, negative, light,
                                                             constants, lit);
    case ShadowMode::subtractShadow:
      addLight<kKind, ShadowMode::subtractShadow, kFine>(block, packets, negative, light, constants,
                                                         lit);
      return addMasked<kKind, kFine>(block, packets, negative, light, constants, lit);
  }
}

// Calls f.operator()<kind, isFine>().
template <bool kFine, typename F>
void byKind(LightRecord::Kind kind, F&& f) {
  switch (kind) {
    case LightRecord::Kind::cosine:
      return f.template operator()<LightRecord::Kind::cosine, kFine>();
    case LightRecord::Kind::uniform:
      return f.template operator()<LightRecord::Kind::uniform, kFine>();
    case LightRecord::Kind::directional:
      return f.template operator()<LightRecord::Kind::directional, kFine>();
  }
}

template <typename F>
void dispatch(LightRecord::Kind kind, const SumConstants& constants, F&& f) {
  constants.isFine ? byKind<true>(kind, f) : byKind<false>(kind, f);
}

}  // namespace

void PacketLanes::add(const PacketLanes& more) {
  for (size_t i = 0; i < of.size(); i += kBytes) {
    const auto both = hn::Or(hn::Load(kByteTag, &of[i]), hn::Load(kByteTag, &more.of[i]));
    hn::Store(both, kByteTag, &of[i]);
  }
}

void PacketList::take(const PacketLanes& lanes) {
  lanes_ = lanes;
  count_ = 0;
  for (size_t i = 0; i < lanes.of.size(); i += kBytes) {
    const auto some = hn::Ne(hn::Load(kByteTag, &lanes.of[i]), hn::Zero(kByteTag));
    for (uint32_t rest = bitsOf(some); rest != 0; rest &= rest - 1)
      packet_[count_++] = static_cast<uint8_t>(i + static_cast<size_t>(std::countr_zero(rest)));
  }
}

LightRecord makeLightRecord(const shared::Vpl& vpl, const float* map, int resolution) {
  LightRecord light;
  light.kind = vpl.position.w == shared::kVplCosine    ? LightRecord::Kind::cosine
               : vpl.position.w == shared::kVplUniform ? LightRecord::Kind::uniform
                                                       : LightRecord::Kind::directional;
  light.map = map;
  light.resolution = map == nullptr ? 1 : resolution;
  light.slot = vpl.slot;
  light.position = vec3(vpl.position);
  light.normal = vec3(vpl.normal);
  light.tangent = vec3(vpl.tangent);
  light.bitangent = glm::cross(light.normal, light.tangent);
  light.intensity = vpl.intensity;
  light.coneScale = light.radius = vpl.normal.w;
  light.coneOffset = light.side = vpl.tangent.w;
  light.link = static_cast<uint32_t>(vpl.footprint.y);
  return light;
}

void addLight(PacketBlock& block, const PacketList& packets, ShadowMode use, Sign sign,
              const LightRecord& light, const SumConstants& constants, ShadowMasks& lit) {
  if (packets.count() == 0) return;
  dispatch(light.kind, constants, [&]<LightRecord::Kind kKind, bool kFine>() {
    addLight<kKind, kFine>(block, packets, use, sign, light, constants, lit);
  });
}

void addMasked(PacketBlock& block, const PacketList& packets, ShadowMode use, Sign sign,
               const LightRecord& light, const SumConstants& constants, const ShadowMasks& lit) {
  if (packets.count() == 0) return;
  dispatch(light.kind, constants, [&]<LightRecord::Kind kKind, bool kFine>() {
    addMasked<kKind, kFine>(block, packets, isNegative(use, sign), light, constants, lit);
  });
}

void replaceMasked(PacketBlock& block, const PacketList& packets, ShadowMode use,
                   const LightRecord& before, const LightRecord& now, const SumConstants& constants,
                   const ShadowMasks& lit) {
  if (packets.count() == 0) return;
  const bool negative = isNegative(use, Sign::add);
  const SimdLight light(now, negative, constants), was(before, negative, constants);
  dispatch(now.kind, constants, [&]<LightRecord::Kind kKind, bool kFine>() {
    forEachLit<kKind>(block, packets, light, constants, lit, [&](size_t i, Floats weight) {
      replaceIn<kFine>(block, i, weight, light.units, was.units);
    });
  });
}

}  // namespace lamplighter::cpu
