// x86-64-v3 has no AES instructions, which Highway wants of its AVX2 target unless told otherwise.
#define HWY_DISABLE_PCLMUL_AES 1

#include "renderer/backends/cpu/sum_vpls.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include <hwy/highway.h>

#include "renderer/light_maps/patch_lights.h"

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

// Of shadow maps, in the second-level cache beside the tiles.
constexpr size_t kMapBytesAtOnce = size_t{512} << 10;

struct Vector3 {
  Floats x, y, z;
};

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
      : resolution(all(static_cast<float>(c.resolution))),
        half(all(0.5f * static_cast<float>(c.resolution))),
        last(all(static_cast<float>(c.resolution - 1))),
        step(all(2.0f / static_cast<float>(c.resolution))),
        first(all(1.0f / static_cast<float>(c.resolution) - 1.0f)),
        beforePlane(all(1.0f + c.bias)),
        beforePoint(all(1.0f + c.bias + 1.0f / static_cast<float>(c.resolution))),
        clampDistance2(all(c.clampDistance2)) {}

  Floats resolution, half, last, step, first;
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

// The index of a texel is a whole number that a float holds: maps have at most 1024² texels.
HWY_INLINE Floats fetch(const float* map, const Texel& s, const Texel& t, const WideConstants& c) {
  const Floats texel = hn::MulAdd(t.index, c.resolution, s.index);
  return hn::GatherIndex(kTag, map, hn::ConvertTo(IntTag(), texel));
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
  const Mask beforePoint = hn::Gt(hn::Mul(stored, w), c.beforePoint);
  // Mostly nothing is; then the plane need not be asked.
  if (hn::AllFalse(kTag, beforePoint)) return beforePoint;
  const Floats ex = hn::Mul(hn::Add(s.centre, t.centre), all(0.5f));
  const Floats ey = hn::Mul(hn::Sub(s.centre, t.centre), all(0.5f));
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

// Packets of a tile, and which of their lanes are meant.
class PacketList {
 public:
  void clear() { count_ = 0; }
  void add(size_t first, uint8_t lanes) {
    first_[count_] = first;
    lanes_[count_++] = lanes;
  }
  size_t count() const { return count_; }
  size_t first(size_t k) const { return first_[k]; }
  HWY_INLINE Mask lanes(size_t k) const { return hn::LoadMaskBits(kTag, &lanes_[k]); }

 private:
  size_t first_[kPacketsPerTile];
  uint8_t lanes_[kPacketsPerTile];
  size_t count_ = 0;
};

// kUse: add, addShadowed or takeShadow.
template <LightRecord::Kind kKind, LightUse kUse>
void addLight(const GBuffer& g, const PacketList& packets, const LightRecord& record,
              const SumConstants& constants, Irradiance& out) {
  constexpr bool kLooksUp = kUse != LightUse::add;
  const WideLight light(record, constants);
  const WideConstants c(constants);
  const Floats zero = hn::Zero(kTag);
  const Vectors positions(g.px, g.py, g.pz), shadings(g.sx, g.sy, g.sz),
      geometrics(g.gx, g.gy, g.gz);
  float* HWY_RESTRICT red = out.r.data();
  float* HWY_RESTRICT green = out.g.data();
  float* HWY_RESTRICT blue = out.b.data();
  for (size_t k = 0; k < packets.count(); ++k) {
    const size_t i = packets.first(k);
    const Mask meant = packets.lanes(k);
    const Vector3 p = positions.at(i);
    const Vector3 v{hn::Sub(p.x, light.position.x), hn::Sub(p.y, light.position.y),
                    hn::Sub(p.z, light.position.z)};
    const Vector3 shading = shadings.at(i), geometric = geometrics.at(i);
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
      const Floats s = hn::Neg(dot(shading, v)), facing = hn::Neg(dot(geometric, v));
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
    if constexpr (kUse == LightUse::addShadowed) weight = hn::IfThenZeroElse(occluded, weight);
    if constexpr (kUse == LightUse::takeShadow) {
      weight = hn::Neg(hn::IfThenElseZero(occluded, weight));
    }
    const auto add = [&](float* to, Floats intensity) {
      hn::StoreU(hn::MulAdd(weight, intensity, hn::LoadU(kTag, to)), kTag, to);
    };
    add(red + i, light.intensity.x);
    add(green + i, light.intensity.y);
    add(blue + i, light.intensity.z);
  }
}

template <LightUse kUse>
void addLight(const GBuffer& gbuffer, const PacketList& packets, const LightRecord& light,
              const SumConstants& constants, Irradiance& out) {
  if (packets.count() == 0) return;
  switch (light.kind) {
    case LightRecord::Kind::cosine:
      return addLight<LightRecord::Kind::cosine, kUse>(gbuffer, packets, light, constants, out);
    case LightRecord::Kind::uniform:
      return addLight<LightRecord::Kind::uniform, kUse>(gbuffer, packets, light, constants, out);
    case LightRecord::Kind::directional:
      return addLight<LightRecord::Kind::directional, kUse>(gbuffer, packets, light, constants,
                                                            out);
  }
}

// Where the lanes of a tile's packets lie, and what that makes of each light. Packets whose lanes
// lie in the same leaves are of one kind, and few kinds are in a tile.
class TileLights {
 public:
  TileLights(const GBuffer& g, std::span<const size_t> packets, const PatchLights& lights)
      : g_(g), lights_(lights) {
    for (const size_t first : packets) {
      std::array<int, kLanes> places;
      for (size_t lane = 0; lane < kLanes; ++lane) places[lane] = placeOf(first + lane);
      const auto it = std::find_if(kinds_.begin(), kinds_.end(),
                                   [&](const Kind& k) { return k.places == places; });
      Kind& kind = it == kinds_.end() ? kinds_.emplace_back() : *it;
      kind.places = places;
      kind.packets.push_back(first);
    }
    static_assert(kPacketsPerTile <= 32);  // kinds fit the bits
    for (auto& kinds : kindsWith_) kinds.assign(lights.slots(), 0);
    for (size_t k = 0; k < kinds_.size(); ++k) {
      Kind& kind = kinds_[k];
      for (auto& lanes : kind.lanes) lanes.assign(lights.slots(), 0);
      for (size_t place = 0; place < places_.size(); ++place) {
        uint8_t here = 0;
        for (size_t lane = 0; lane < kLanes; ++lane)
          if (kind.places[lane] == static_cast<int>(place))
            here |= static_cast<uint8_t>(1u << lane);
        if (here == 0) continue;
        const std::vector<LightUse>& uses = places_[place].uses;
        for (int use = 1; use < 4; ++use) {
          uint8_t* lanes = kind.lanes[use].data();
          for (size_t slot = 0; slot < uses.size(); ++slot)
            lanes[slot] |= uses[slot] == static_cast<LightUse>(use) ? here : 0;
        }
      }
      const uint32_t bit = uint32_t{1} << k;
      for (int use = 1; use < 4; ++use) {
        const uint8_t* lanes = kind.lanes[use].data();
        uint32_t* kinds = kindsWith_[use].data();
        for (size_t slot = 0; slot < lights.slots(); ++slot)
          kinds[slot] |= lanes[slot] != 0 ? bit : 0;
      }
    }
  }

  // The tile's packets that use the light so.
  void list(int slot, LightUse use, PacketList& out) const {
    out.clear();
    const auto u = static_cast<size_t>(use), s = static_cast<size_t>(slot);
    for (uint32_t kinds = kindsWith_[u][s]; kinds != 0; kinds &= kinds - 1) {
      const Kind& kind = kinds_[static_cast<size_t>(std::countr_zero(kinds))];
      for (const size_t first : kind.packets) out.add(first, kind.lanes[u][s]);
    }
  }

  // Lanes on a light map begin with what it says.
  void beginWithMaps(Irradiance& out) const {
    for (const Kind& kind : kinds_) {
      for (size_t lane = 0; lane < kLanes; ++lane) {
        if (kind.places[lane] == kNone) continue;
        const Place& place = places_[static_cast<size_t>(kind.places[lane])];
        if (!place.mapped) continue;
        for (const size_t first : kind.packets) {
          const size_t i = first + lane;
          const vec3 e = lights_.maps()->irradiance(lights_.patches(place.object), place.object,
                                                    place.leaf, vec3(g_.px[i], g_.py[i], g_.pz[i]));
          out.r[i] = e.r;
          out.g[i] = e.g;
          out.b[i] = e.b;
        }
      }
    }
  }

 private:
  struct Place {
    uint32_t object;
    int leaf;
    bool mapped;                 // its pixels begin with the light map
    std::vector<LightUse> uses;  // by slot
  };
  struct Kind {
    std::array<int, kLanes> places;             // into places_; kNone: nothing is hit
    std::vector<size_t> packets;                // their first pixels
    std::array<std::vector<uint8_t>, 4> lanes;  // by LightUse, then slot: a bit a lane
  };

  int placeOf(size_t i) {
    if (g_.hit[i] == 0) return kNone;
    const uint32_t object = g_.object[i];
    const ObjectPatches& patches = lights_.patches(object);
    const int leaf = patches.leafAt(g_.triangle[i], vec3(g_.px[i], g_.py[i], g_.pz[i]));
    const int chart = patches.patches[static_cast<size_t>(leaf)].chart;
    const bool mapped = lights_.isMapped(object, leaf) &&
                        glm::dot(vec3(g_.gx[i], g_.gy[i], g_.gz[i]),
                                 patches.charts[static_cast<size_t>(chart)].normal) > 0.0f;
    // Neighbours are mostly in the place found last.
    for (size_t k = places_.size(); k-- > 0;) {
      const Place& p = places_[k];
      if (p.object == object && p.leaf == leaf && p.mapped == mapped) return static_cast<int>(k);
    }
    Place& place = places_.emplace_back(Place{object, leaf, mapped, {}});
    place.uses.resize(lights_.slots());
    lights_.uses(object, leaf, mapped, place.uses);
    return static_cast<int>(places_.size()) - 1;
  }

  const GBuffer& g_;
  const PatchLights& lights_;
  std::vector<Place> places_;
  std::vector<Kind> kinds_;
  std::array<std::vector<uint32_t>, 4> kindsWith_;  // by LightUse, then slot: a bit a kind
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

namespace {

// One tile's sums on their way: what of it is hit, and how its patches come by each light.
class TileSum {
 public:
  TileSum(const GBuffer& gbuffer, int tile, const PatchLights* patches, Irradiance& out)
      : gbuffer_(gbuffer), out_(out), first_(static_cast<size_t>(tile) * kTilePixels) {
    std::fill_n(&out.r[first_], kTilePixels, 0.0f);
    std::fill_n(&out.g[first_], kTilePixels, 0.0f);
    std::fill_n(&out.b[first_], kTilePixels, 0.0f);
    std::vector<size_t> packets;
    for (size_t i = first_; i < first_ + kTilePixels; i += kLanes) {
      if (std::none_of(&gbuffer.hit[i], &gbuffer.hit[i] + kLanes, [](uint8_t h) { return h != 0; }))
        continue;
      packets.push_back(i);
      every_.add(i, kEveryLane);
    }
    if (patches == nullptr || packets.empty()) return;
    lights_.emplace(gbuffer, packets, *patches);
    isMapped_ = patches->maps() != nullptr;
    if (isMapped_) lights_->beginWithMaps(out);
  }

  // Returns how many light·pixels had a look-up.
  uint64_t add(const LightRecord& light, const SumConstants& constants) {
    if (every_.count() == 0) return 0;
    if (!lights_ || light.slot < 0) {
      if (light.map == nullptr) {
        addLight<LightUse::add>(gbuffer_, every_, light, constants, out_);
        return 0;
      }
      addLight<LightUse::addShadowed>(gbuffer_, every_, light, constants, out_);
      return every_.count() * kLanes;
    }
    PacketList list;
    lights_->list(light.slot, LightUse::add, list);
    addLight<LightUse::add>(gbuffer_, list, light, constants, out_);
    lights_->list(light.slot, LightUse::addShadowed, list);
    addLight<LightUse::addShadowed>(gbuffer_, list, light, constants, out_);
    uint64_t lookUps = list.count() * kLanes;
    lights_->list(light.slot, LightUse::takeShadow, list);
    addLight<LightUse::takeShadow>(gbuffer_, list, light, constants, out_);
    return lookUps + list.count() * kLanes;
  }

  void finish() {
    // The map is interpolated and what is taken away is not: no light may be left less than none.
    if (!isMapped_) return;
    for (auto* v : {&out_.r, &out_.g, &out_.b})
      for (size_t i = first_; i < first_ + kTilePixels; ++i) (*v)[i] = std::max((*v)[i], 0.0f);
  }

 private:
  static constexpr uint8_t kEveryLane = 0xff;
  const GBuffer& gbuffer_;
  Irradiance& out_;
  size_t first_;
  PacketList every_;
  std::optional<TileLights> lights_;
  bool isMapped_ = false;
};

}  // namespace

uint64_t sumTiles(const GBuffer& gbuffer, int firstTile, int lastTile,
                  std::span<const LightRecord> lights, const SumConstants& constants,
                  const PatchLights* patches, Irradiance& out) {
  static_assert(hn::MaxLanes(kTag) == kLanes);
  std::vector<TileSum> tiles;
  tiles.reserve(static_cast<size_t>(lastTile - firstTile));
  for (int tile = firstTile; tile < lastTile; ++tile)
    tiles.emplace_back(gbuffer, tile, patches, out);
  // The maps of some lights fit the second-level cache, those of all do not: each is fetched for
  // all of the tiles at once. At every pixel the lights still follow in their order.
  const size_t texels = static_cast<size_t>(constants.resolution) * constants.resolution;
  const size_t atOnce = std::max<size_t>(1, kMapBytesAtOnce / (texels * sizeof(float)));
  uint64_t lookUps = 0;
  for (size_t first = 0; first < lights.size(); first += atOnce) {
    const auto some = lights.subspan(first, std::min(atOnce, lights.size() - first));
    for (TileSum& tile : tiles)
      for (const LightRecord& light : some) lookUps += tile.add(light, constants);
  }
  for (TileSum& tile : tiles) tile.finish();
  return lookUps;
}

}  // namespace lamplighter::cpu
