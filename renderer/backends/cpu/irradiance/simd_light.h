// SIMD versions of lights and points, eight lanes, for light_kernel.cpp and specular_kernel.cpp
// only. shaders/shared/vpl_shading.h is the definition and explains it. The formulas here are the
// same, with fused multiply-adds where written.
#pragma once

#include <algorithm>

#include "renderer/backends/cpu/irradiance/light_kernel.h"
#include "renderer/base/simd.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter::cpu {

using Tag = FloatTag;
using IntTag = hn::RebindToSigned<Tag>;
using Floats = Floats8;
using Mask = hn::Mask<Tag>;
static_assert(hn::MaxLanes(kTag) == kLanes);

// The upper bound of a light's weight [1/m²], which bounds the sums. It is reached by a punctual
// light at 6 cm. For a VPL on a surface the clamp is the tighter bound.
inline constexpr float kMostUniformWeight = 256.0f;
inline constexpr float kMostCosineWeight = 4096.0f;

inline float mostWeight(LightRecord::Kind kind, float clampDistance2) {
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

using Vector3 = SimdVec3<Floats>;

using Ints = hn::Vec<IntTag>;

HWY_INLINE Floats dot(const Vector3& a, const Vector3& b) { return dotFused(a, b); }
// Three arrays, as local pointers, so that the compiler knows that other stores do not change them.
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

// The light broadcast to all lanes, so that the pixel loop reads vector operands from the stack.
struct SimdLight {
  SimdLight(const LightRecord& light, bool isNegative, const SumConstants& c)
      : map(light.map),
        position(broadcast(light.position)),
        normal(broadcast(light.normal)),
        tangent(broadcast(light.tangent)),
        bitangent(broadcast(light.bitangent)),
        units(broadcast((isNegative ? -c.unitsPerIrradiance : c.unitsPerIrradiance) *
                        light.intensity)),
        mostWeight(broadcast(cpu::mostWeight(light.kind, c.clampDistance2))),
        coneScale(broadcast(light.coneScale)),
        coneOffset(broadcast(light.coneOffset)),
        side(broadcast(light.side)),
        inverseSide(broadcast(1.0f / light.side)),
        depth(broadcast(2.0f * light.radius)),
        deepest(broadcast(-light.radius - c.bias * light.side)) {}

  const float* map;
  Vector3 position, normal, tangent, bitangent;
  Vector3 units;  // intensity in units of the sums
  Floats mostWeight;
  Floats coneScale, coneOffset;
  Floats side, inverseSide, depth, deepest;  // directional lights
};

// Constants of the map's grid and of the shadow test, broadcast to all lanes.
struct SimdConstants {
  // side: texels per side of the light's map.
  SimdConstants(const SumConstants& c, int side)
      : resolution(broadcast(static_cast<float>(side))),
        middle(broadcast(0.5f * static_cast<float>(side))),
        half(broadcast(0.5f * static_cast<float>(side) * (1.0f - 0x1p-21f))),
        lastTexel(hn::Set(hn::RebindToUnsigned<Tag>(), static_cast<uint32_t>(side * side - 1))),
        step(broadcast(2.0f / static_cast<float>(side))),
        steep(broadcast(shared::kSteepTexels * 2.0f / static_cast<float>(side))),
        first(broadcast(1.0f / static_cast<float>(side) - 1.0f)),
        beforePlane(broadcast(1.0f + c.bias)),
        beforePoint(broadcast(1.0f + c.bias + shared::kCornerTexels / static_cast<float>(side))),
        clampDistance2(broadcast(c.clampDistance2)),
        perClampDistance2(broadcast(1.0f / c.clampDistance2)) {}

  Floats resolution, middle, half;
  hn::Vec<hn::RebindToUnsigned<Tag>> lastTexel;
  Floats step, steep, first;
  Floats beforePlane, beforePoint;
  Floats clampDistance2, perClampDistance2;
};

// The texel column or row of a coordinate in [-1, 1]. `half` is slightly smaller than the exact
// value, so that rounding never leads outside the map.
HWY_INLINE Floats texelOf(Floats s, const SimdConstants& c) {
  return hn::Floor(hn::MulAdd(s, c.half, c.middle));
}
HWY_INLINE Floats centreOf(Floats texel, const SimdConstants& c) {
  return hn::MulAdd(texel, c.step, c.first);
}

// A texel index is an integer that a float represents exactly: maps have at most 1024² texels. The
// bound is for NaN coordinates.
HWY_INLINE Floats fetch(const float* map, Floats s, Floats t, const SimdConstants& c) {
  const Ints texel = truncateToInts(hn::MulAdd(t, c.resolution, s));
  const hn::RebindToUnsigned<Tag> unsignedTag;
  const auto bounded = hn::Min(hn::BitCast(unsignedTag, texel), c.lastTexel);
  return hn::GatherIndex(kTag, map, hn::BitCast(IntTag(), bounded));
}

// Transforms a normal to the light's frame: tangent, bitangent, normal.
HWY_INLINE Vector3 inFrameOf(const SimdLight& light, const Vector3& n) {
  return {dot(n, light.tangent), dot(n, light.bitangent), dot(n, light.normal)};
}

// v: from the light to the point; z: its height over the light's plane, > 0. geometric(): returns
// the normal of the point's plane in the light's frame, called only when needed. kIsMostly: most
// points are occluded, so an early exit would cost more than it saves.
template <bool kIsMostly = false, typename F>
HWY_INLINE Mask hemisphereOccluded(const SimdLight& light, const SimdConstants& c, const Vector3& v,
                                   Floats z, F&& geometric, Floats facing) {
  const Floats x = dot(v, light.tangent), y = dot(v, light.bitangent);
  const Floats w = hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), z);
  const Floats inverse = hn::Div(broadcast(1.0f), w);
  const Floats s = texelOf(hn::Mul(hn::Add(x, y), inverse), c);
  const Floats t = texelOf(hn::Mul(hn::Sub(x, y), inverse), c);
  const Floats stored = fetch(light.map, s, t, c);
  const Mask beforePoint = hn::Gt(hn::Mul(stored, w), c.beforePoint);
  // Usually nothing is occluded; then the plane is not needed.
  if (!kIsMostly && hn::AllFalse(kTag, beforePoint)) return beforePoint;
  const Floats cs = centreOf(s, c), ct = centreOf(t, c);
  const Floats ex = hn::Mul(hn::Add(cs, ct), broadcast(0.5f));
  const Floats ey = hn::Mul(hn::Sub(cs, ct), broadcast(0.5f));
  const Floats ez = hn::Sub(broadcast(1.0f), hn::Add(hn::Abs(ex), hn::Abs(ey)));
  const Vector3& n = geometric();
  const Floats plane = hn::MulAdd(n.x, ex, hn::MulAdd(n.y, ey, hn::Mul(n.z, ez)));
  // facing = −n·v > 0
  const Mask beforePlane =
      hn::Gt(hn::MulAdd(stored, facing, hn::Mul(c.beforePlane, plane)), hn::Zero(kTag));
  return hn::And(beforePoint, beforePlane);
}

// q: the point in the light's frame.
HWY_INLINE Mask directionalOccluded(const SimdLight& light, const SimdConstants& c,
                                    const Vector3& q, const Vector3& geometric, Floats facing) {
  // Clamps to the square; only needed in lanes that count.
  const auto inSquare = [](Floats v) {
    return hn::Max(hn::Min(v, broadcast(1.0f)), broadcast(-1.0f));
  };
  const Floats s = texelOf(inSquare(hn::Mul(q.x, light.inverseSide)), c);
  const Floats t = texelOf(inSquare(hn::Mul(q.y, light.inverseSide)), c);
  const Floats stored = fetch(light.map, s, t, c);
  const Floats above = hn::Sub(hn::MulAdd(stored, light.depth, light.deepest), q.z);
  const Floats dx = hn::MulSub(centreOf(s, c), light.side, q.x);
  const Floats dy = hn::MulSub(centreOf(t, c), light.side, q.y);
  const Floats slope =
      hn::MulAdd(dot(geometric, light.tangent), dx, hn::Mul(dot(geometric, light.bitangent), dy));
  const Mask beforePoint = hn::Gt(above, hn::Zero(kTag));
  const Mask beforePlane = hn::Or(hn::Gt(hn::MulAdd(above, facing, slope), hn::Zero(kTag)),
                                  hn::Gt(above, hn::Mul(c.steep, light.side)));
  return hn::And(beforePoint, beforePlane);
}

}  // namespace lamplighter::cpu
