// x86-64-v3 has no AES instructions, which Highway wants of its AVX2 target unless told otherwise.
#define HWY_DISABLE_PCLMUL_AES 1

#include "renderer/backends/cpu/sum_vpls.h"

#include <algorithm>
#include <utility>

#include <hwy/highway.h>

#include "renderer/visibility/visibility_database.h"

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

struct Vector3 {
  Floats x, y, z;
};

HWY_INLINE Floats all(float v) { return hn::Set(kTag, v); }
HWY_INLINE Floats dot(const Vector3& a, const Vector3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Vector3 load(const std::vector<float>& x, const std::vector<float>& y,
                        const std::vector<float>& z, size_t i) {
  return {hn::LoadU(kTag, &x[i]), hn::LoadU(kTag, &y[i]), hn::LoadU(kTag, &z[i])};
}

HWY_INLINE Vector3 all(const vec3& v) { return {all(v.x), all(v.y), all(v.z)}; }

// The light in every lane, so that the loop over pixels takes it as vector operands from the stack.
struct WideLight {
  explicit WideLight(const LightRecord& light, const SumConstants& c)
      : map(light.map),
        position(all(light.position)),
        normal(all(light.normal)),
        tangent(all(light.tangent)),
        bitangent(all(light.bitangent)),
        intensity(all(light.intensity)),
        coneScale(all(light.coneScale)),
        coneOffset(all(light.coneOffset)),
        side(all(light.side)),
        inverseSide(all(1.0f / light.side)),
        depth(all(2.0f * light.radius)),
        deepest(all(-light.radius - c.bias * light.side)) {}

  const float* map;
  Vector3 position, normal, tangent, bitangent, intensity;
  Floats coneScale, coneOffset;
  Floats side, inverseSide, depth, deepest;  // directional
};

// Numbers of the map's grid and of the test in every lane.
struct WideConstants {
  explicit WideConstants(const SumConstants& c)
      : resolution(hn::Set(IntTag(), c.resolution)),
        half(all(0.5f * static_cast<float>(c.resolution))),
        last(all(static_cast<float>(c.resolution - 1))),
        step(all(2.0f / static_cast<float>(c.resolution))),
        first(all(1.0f / static_cast<float>(c.resolution) - 1.0f)),
        beforePlane(all(1.0f + c.bias)),
        beforePoint(all(1.0f + c.bias + 1.0f / static_cast<float>(c.resolution))),
        clampDistance2(all(c.clampDistance2)) {}

  hn::Vec<IntTag> resolution;
  Floats half, last, step, first;
  Floats beforePlane, beforePoint;
  Floats clampDistance2;
};

// The texel's column or row, and its centre, of one square coordinate.
struct Texel {
  Floats index, centre;
};
HWY_INLINE Texel texelOf(Floats s, const WideConstants& c) {
  const Floats i = hn::Floor(hn::MulAdd(s, c.half, c.half));
  const Floats index = hn::Min(hn::Max(i, hn::Zero(kTag)), c.last);
  return {index, hn::MulAdd(index, c.step, c.first)};
}

HWY_INLINE Floats fetch(const float* map, const Texel& s, const Texel& t, const WideConstants& c) {
  const IntTag ints;
  const auto column = hn::ConvertTo(ints, s.index), row = hn::ConvertTo(ints, t.index);
  return hn::GatherIndex(kTag, map, hn::Add(hn::Mul(row, c.resolution), column));
}

// v: from the light to the point; z: its height over the light's plane, > 0.
HWY_INLINE Mask hemisphereOccluded(const WideLight& light, const WideConstants& c, const Vector3& v,
                                   Floats z, const Vector3& geometric, Floats facing) {
  const Floats x = dot(v, light.tangent), y = dot(v, light.bitangent);
  const Floats w = hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), z);
  const Floats inverse = hn::Div(all(1.0f), w);
  const Texel s = texelOf(hn::Mul(hn::Add(x, y), inverse), c);
  const Texel t = texelOf(hn::Mul(hn::Sub(x, y), inverse), c);
  const Floats stored = fetch(light.map, s, t, c);
  const Floats ex = hn::Mul(hn::Add(s.centre, t.centre), all(0.5f));
  const Floats ey = hn::Mul(hn::Sub(s.centre, t.centre), all(0.5f));
  const Floats ez = hn::Sub(all(1.0f), hn::Add(hn::Abs(ex), hn::Abs(ey)));
  const Floats plane = hn::MulAdd(
      dot(geometric, light.tangent), ex,
      hn::MulAdd(dot(geometric, light.bitangent), ey, hn::Mul(dot(geometric, light.normal), ez)));
  const Mask beforePoint = hn::Gt(hn::Mul(stored, w), c.beforePoint);
  // facing = −n·v > 0
  const Mask beforePlane =
      hn::Gt(hn::MulAdd(stored, facing, hn::Mul(c.beforePlane, plane)), hn::Zero(kTag));
  return hn::And(beforePoint, beforePlane);
}

// q: the point in the light's frame.
HWY_INLINE Mask directionalOccluded(const WideLight& light, const WideConstants& c,
                                    const Vector3& q, const Vector3& geometric, Floats facing) {
  const Texel s = texelOf(hn::Mul(q.x, light.inverseSide), c);
  const Texel t = texelOf(hn::Mul(q.y, light.inverseSide), c);
  const Floats stored = fetch(light.map, s, t, c);
  const Floats above = hn::Sub(hn::MulAdd(stored, light.depth, light.deepest), q.z);
  const Floats dx = hn::MulSub(s.centre, light.side, q.x);
  const Floats dy = hn::MulSub(t.centre, light.side, q.y);
  const Floats slope =
      hn::MulAdd(dot(geometric, light.tangent), dx, hn::Mul(dot(geometric, light.bitangent), dy));
  const Mask beforePoint = hn::Gt(above, hn::Zero(kTag));
  const Mask beforePlane = hn::Gt(hn::MulAdd(above, facing, slope), hn::Zero(kTag));
  return hn::And(beforePoint, beforePlane);
}

template <LightRecord::Kind kKind>
void addLight(const GBuffer& g, std::span<const size_t> packets, const LightRecord& record,
              const SumConstants& constants, Irradiance& out) {
  const WideLight light(record, constants);
  const WideConstants c(constants);
  const Floats zero = hn::Zero(kTag);
  for (const size_t i : packets) {
    const Vector3 p = load(g.px, g.py, g.pz, i);
    const Vector3 v{hn::Sub(p.x, light.position.x), hn::Sub(p.y, light.position.y),
                    hn::Sub(p.z, light.position.z)};
    const Vector3 shading = load(g.sx, g.sy, g.sz, i);
    const Vector3 geometric = load(g.gx, g.gy, g.gz, i);
    Floats weight;
    Mask occluded = hn::MaskFromVec(hn::Zero(kTag));
    if constexpr (kKind == LightRecord::Kind::directional) {
      const Vector3 q{dot(v, light.tangent), dot(v, light.bitangent), dot(v, light.normal)};
      const Floats s = dot(shading, light.normal), facing = dot(geometric, light.normal);
      const Floats side = light.side;
      const Mask within = hn::And(hn::And(hn::Ge(q.x, hn::Neg(side)), hn::Lt(q.x, side)),
                                  hn::And(hn::Ge(q.y, hn::Neg(side)), hn::Lt(q.y, side)));
      const Mask lit = hn::And(within, hn::And(hn::Gt(s, zero), hn::Gt(facing, zero)));
      if (hn::AllFalse(kTag, lit)) continue;
      weight = hn::IfThenElseZero(lit, s);
      if (light.map) occluded = directionalOccluded(light, c, q, geometric, facing);
    } else {
      const Floats z = dot(v, light.normal);
      const Floats s = hn::Neg(dot(shading, v)), facing = hn::Neg(dot(geometric, v));
      const Mask lit = hn::And(hn::Gt(z, zero), hn::And(hn::Gt(s, zero), hn::Gt(facing, zero)));
      if (hn::AllFalse(kTag, lit)) continue;
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
      // A height above zero keeps 1/w finite in the lanes that the light does not reach.
      const Floats height = hn::IfThenElse(lit, z, all(1.0f));
      if (light.map) occluded = hemisphereOccluded(light, c, v, height, geometric, facing);
    }
    weight = hn::IfThenZeroElse(occluded, weight);
    float* r = &out.r[i];
    float* gr = &out.g[i];
    float* b = &out.b[i];
    hn::StoreU(hn::MulAdd(weight, light.intensity.x, hn::LoadU(kTag, r)), kTag, r);
    hn::StoreU(hn::MulAdd(weight, light.intensity.y, hn::LoadU(kTag, gr)), kTag, gr);
    hn::StoreU(hn::MulAdd(weight, light.intensity.z, hn::LoadU(kTag, b)), kTag, b);
  }
}

void addLight(const GBuffer& gbuffer, std::span<const size_t> packets, const LightRecord& light,
              const SumConstants& constants, Irradiance& out) {
  switch (light.kind) {
    case LightRecord::Kind::cosine:
      return addLight<LightRecord::Kind::cosine>(gbuffer, packets, light, constants, out);
    case LightRecord::Kind::uniform:
      return addLight<LightRecord::Kind::uniform>(gbuffer, packets, light, constants, out);
    case LightRecord::Kind::directional:
      return addLight<LightRecord::Kind::directional>(gbuffer, packets, light, constants, out);
  }
}

// What the visibility database says of each packet of a tile and each light: of the patches under
// its pixels, partial where they differ. Few kinds of packets are in a tile; each has a row.
class TileStates {
 public:
  TileStates(const GBuffer& g, std::span<const size_t> packets, std::span<const LightRecord> lights,
             const VisibilityDatabase& visibility) {
    kinds_.reserve(packets.size());
    std::vector<std::vector<Patch>> known;
    for (const size_t first : packets) {
      std::vector<Patch> patches;
      for (size_t i = first; i < first + kLanes; ++i) {
        if (g.hit[i] == 0) continue;
        const vec3 p(g.px[i], g.py[i], g.pz[i]);
        const Patch patch{g.object[i], visibility.patches(g.object[i]).leafAt(g.triangle[i], p)};
        if (std::find(patches.begin(), patches.end(), patch) == patches.end())
          patches.push_back(patch);
      }
      std::sort(patches.begin(), patches.end());
      const auto it = std::find(known.begin(), known.end(), patches);
      kinds_.push_back(static_cast<size_t>(it - known.begin()));
      if (it == known.end()) known.push_back(std::move(patches));
    }
    rows_.resize(known.size());
    for (size_t kind = 0; kind < known.size(); ++kind) {
      for (const LightRecord& light : lights) {
        Occlusion state = stateOf(visibility, known[kind][0], light.slot);
        for (const Patch& patch : known[kind])
          if (stateOf(visibility, patch, light.slot) != state) state = Occlusion::partial;
        rows_[kind].push_back(state);
      }
    }
  }
  Occlusion of(size_t packet, size_t light) const { return rows_[kinds_[packet]][light]; }

 private:
  using Patch = std::pair<uint32_t, int>;  // object, leaf
  static Occlusion stateOf(const VisibilityDatabase& v, const Patch& p, int slot) {
    return slot < 0 ? Occlusion::none : v.state(p.first, p.second, slot);
  }

  std::vector<size_t> kinds_;                 // by packet
  std::vector<std::vector<Occlusion>> rows_;  // by kind, then light
};

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

uint64_t sumTile(const GBuffer& gbuffer, int tile, std::span<const LightRecord> lights,
                 const SumConstants& constants, const VisibilityDatabase* visibility,
                 Irradiance& out) {
  static_assert(hn::MaxLanes(kTag) == kLanes);
  const size_t first = static_cast<size_t>(tile) * kTilePixels;
  std::fill_n(&out.r[first], kTilePixels, 0.0f);
  std::fill_n(&out.g[first], kTilePixels, 0.0f);
  std::fill_n(&out.b[first], kTilePixels, 0.0f);
  // Packets that hit something.
  size_t packets[kPacketsPerTile];
  size_t count = 0;
  for (int packet = 0; packet < kPacketsPerTile; ++packet) {
    const size_t i = first + packet * kLanes;
    bool any = false;
    for (int lane = 0; lane < kLanes; ++lane) any = any || gbuffer.hit[i + lane] != 0;
    if (any) packets[count++] = i;
  }
  if (count == 0) return 0;
  const std::span<const size_t> active(packets, count);
  if (visibility == nullptr) {
    for (const LightRecord& light : lights) addLight(gbuffer, active, light, constants, out);
    return lights.size() * count * kLanes;
  }
  const TileStates states(gbuffer, active, lights, *visibility);
  uint64_t lookUps = 0;
  size_t open[kPacketsPerTile], shadowed[kPacketsPerTile];
  for (size_t k = 0; k < lights.size(); ++k) {
    size_t opens = 0, shadoweds = 0;
    for (size_t i = 0; i < count; ++i) {
      const Occlusion state = states.of(i, k);
      if (state == Occlusion::none) open[opens++] = packets[i];
      if (state == Occlusion::partial) shadowed[shadoweds++] = packets[i];
    }
    LightRecord light = lights[k];
    if (shadoweds > 0) addLight(gbuffer, {shadowed, shadoweds}, light, constants, out);
    light.map = nullptr;
    if (opens > 0) addLight(gbuffer, {open, opens}, light, constants, out);
    lookUps += shadoweds * kLanes;
  }
  return lookUps;
}

}  // namespace lamplighter::cpu
