#include "renderer/backends/cpu/gbuffer/raster_tile.h"

#include <algorithm>
#include <bit>

#include "renderer/scene/surface.h"

namespace lamplighter::cpu {
namespace {

using raster::Floats;
using raster::Pixels;
using Mask = hn::Mask<FloatTag>;
using IntTag = hn::RebindToSigned<FloatTag>;

// The corners of a triangle, each coordinate broadcast to all lanes.
class Corners {
 public:
  Corners(const RenderScene& scene, uint32_t object, uint32_t triangle) {
    const uint32_t* index = &scene.indices[scene.objects[object].firstIndex + 3 * triangle];
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        of_[axis][corner] = broadcast(scene.positions[index[corner]][axis]);
  }
  // One coordinate of the points with these barycentric weights.
  Floats at(int axis, const Floats (&w)[3]) const {
    const Floats(&c)[3] = of_[axis];
    return hn::MulAdd(w[2], c[2], hn::MulAdd(w[1], c[1], hn::Mul(w[0], c[0])));
  }

 private:
  Floats of_[3][3];
};

}  // namespace

void Raster::intersect(const Candidate& c, int index, TileHits& hits) const {
  const IntTag ints;
  const Floats most = broadcast(hits.mostInverse), inverseDet = broadcast(c.inverseDet);
  for (int py = c.y0 / kPacketHeight; py <= c.y1 / kPacketHeight; ++py) {
    for (int px = c.x0 / kPacketWidth; px <= c.x1 / kPacketWidth; ++px) {
      const Pixels pixels(py * kPacketsPerRow + px);
      const Floats x = pixels.x, y = pixels.y;
      const Floats e0 = c.edge(0, x, y), e1 = c.edge(1, x, y), e2 = c.edge(2, x, y);
      const size_t at = static_cast<size_t>(py * kPacketsPerRow + px) * kLanes;
      const Floats inverse = hn::Mul(hn::Add(hn::Add(e0, e1), e2), inverseDet);
      const Floats last = hn::Load(kTag, &hits.inverseDistance[at]);
      Mask isHit = hn::And(hn::Gt(inverse, last), hn::Le(inverse, most));
      if (!c.coversAll)
        isHit = hn::And(isHit, hn::Ge(hn::Min(hn::Min(e0, e1), e2), hn::Zero(kTag)));
      if (hn::AllFalse(kTag, isHit)) continue;
      if (c.isMasked) {
        HWY_ALIGN float w0[kLanes], w1[kLanes], w2[kLanes], shows[kLanes];
        hn::Store(e0, kTag, w0);
        hn::Store(e1, kTag, w1);
        hn::Store(e2, kTag, w2);
        const float cutoff =
            scene_.materials[static_cast<size_t>(scene_.objects[c.object].material)].alphaCutoff;
        uint8_t bits[8];
        hn::StoreMaskBits(kTag, isHit, bits);
        for (int lane = 0; lane < kLanes; ++lane) {
          shows[lane] = 0.0f;
          if ((bits[0] >> lane & 1) == 0) continue;
          const float scale = 1.0f / (w0[lane] + w1[lane] + w2[lane]);
          const float alpha =
              alphaAt(scene_, c.object, c.triangle, w1[lane] * scale, w2[lane] * scale);
          shows[lane] = alpha < cutoff ? 0.0f : 1.0f;
        }
        isHit = hn::And(isHit, hn::Gt(hn::Load(kTag, shows), hn::Zero(kTag)));
      }
      hn::Store(hn::IfThenElse(isHit, inverse, last), kTag, &hits.inverseDistance[at]);
      hn::Store(hn::IfThenElse(hn::RebindMask(ints, isHit), hn::Set(ints, index),
                               hn::Load(ints, &hits.candidate[at])),
                ints, &hits.candidate[at]);
    }
  }
}

namespace {

bool isPlain(const RenderScene& s, uint32_t object, uint32_t triangle) {
  const Material& m = s.materials[static_cast<size_t>(s.objects[object].material)];
  for (const TextureRef* ref : {&m.baseColorTexture, &m.normalTexture, &m.emissiveTexture})
    if (ref->texture != kNone) return false;
  const uint32_t* i = &s.indices[s.objects[object].firstIndex + 3 * triangle];
  return s.normals[i[0]] == s.normals[i[1]] && s.normals[i[0]] == s.normals[i[2]] &&
         s.colors[i[0]] == s.colors[i[1]] && s.colors[i[0]] == s.colors[i[2]];
}

// Writes three values to some lanes of three arrays.
void store(Mask lanes, const Floats (&v)[3], std::vector<float>& x, std::vector<float>& y,
           std::vector<float>& z, size_t at) {
  hn::BlendedStore(v[0], lanes, kTag, &x[at]);
  hn::BlendedStore(v[1], lanes, kTag, &y[at]);
  hn::BlendedStore(v[2], lanes, kTag, &z[at]);
}
void store(Mask lanes, const vec3& v, std::vector<float>& x, std::vector<float>& y,
           std::vector<float>& z, size_t at) {
  store(lanes, {broadcast(v.x), broadcast(v.y), broadcast(v.z)}, x, y, z, at);
}

}  // namespace

Raster::Plain Raster::plainOf(uint32_t object, uint32_t triangle) const {
  Plain plain{true, isPlain(scene_, object, triangle), {}};
  if (plain.isPlain) plain.surface = surfaceAt(scene_, object, triangle, 0.25f, 0.25f);
  return plain;
}

void Raster::write(std::span<const Candidate> candidates, const TileHits& hits, int tile,
                   GBuffer& out) const {
  std::vector<Plain> plain(candidates.size());
  const IntTag ints;
  const auto surfaceOf = [&](int index) -> const Plain& {
    const Candidate& c = candidates[static_cast<size_t>(index)];
    if (c.large != kNone) return large_[static_cast<size_t>(c.large)].plain;
    Plain& same = plain[static_cast<size_t>(index)];
    if (!same.isKnown) same = plainOf(c.object, c.triangle);
    return same;
  };
  // The triangle of these pixels if they all show one flat triangle.
  const auto onlyOne = [&](const int32_t* first, size_t pixels) -> const Candidate* {
    const int index = *first;
    const bool isOne = index >= 0 &&
                       std::all_of(first, first + pixels, [&](int c) { return c == index; }) &&
                       surfaceOf(index).isFlat();
    return isOne ? &candidates[static_cast<size_t>(index)] : nullptr;
  };
  uint64_t& onlyTriangle = out.onlyTriangle[static_cast<size_t>(tile)];
  onlyTriangle = GBuffer::kMany;
  if (const Candidate* only = onlyOne(hits.candidate, kTilePixels)) {
    writeFlat(*only, surfaceOf(hits.candidate[0]).surface, tile, 0, kPacketsPerTile, out);
    onlyTriangle = only->name();
    return;
  }
  for (int packet = 0; packet < kPacketsPerTile; ++packet) {
    const size_t in = static_cast<size_t>(packet) * kLanes,
                 at = static_cast<size_t>(tile) * kTilePixels + in;
    if (const Candidate* only = onlyOne(&hits.candidate[in], kLanes)) {
      writeFlat(*only, surfaceOf(hits.candidate[in]).surface, tile, packet, 1, out);
      continue;
    }
    out.packetTriangle[at / kLanes] = GBuffer::kMany;
    const auto which = hn::Load(ints, &hits.candidate[in]);
    const Mask isMiss = hn::RebindMask(kTag, hn::Lt(which, hn::Zero(ints)));
    uint8_t missed[8];
    hn::StoreMaskBits(kTag, isMiss, missed);
    uint32_t left = ~uint32_t{missed[0]} & 0xffu;
    for (int lane = 0; lane < kLanes; ++lane)
      out.hit[at + static_cast<size_t>(lane)] = left >> lane & 1;
    if (missed[0] != 0) {
      store(isMiss, vec3(0.0f), out.sx, out.sy, out.sz, at);
      store(isMiss, vec3(0.0f), out.gx, out.gy, out.gz, at);
    }
    const Pixels pixels(packet);
    while (left != 0) {
      const int index = hits.candidate[in + static_cast<size_t>(std::countr_zero(left))];
      const Candidate& c = candidates[static_cast<size_t>(index)];
      const auto isThis = hn::Eq(which, hn::Set(ints, index));
      const Mask lanes = hn::RebindMask(kTag, isThis);
      uint8_t bits[8];
      hn::StoreMaskBits(kTag, lanes, bits);
      left &= ~uint32_t{bits[0]};
      Floats w[3];
      c.weights(pixels, w);
      const Corners corners(scene_, c.object, c.triangle);
      store(lanes, {corners.at(0, w), corners.at(1, w), corners.at(2, w)}, out.px, out.py, out.pz,
            at);
      hn::BlendedStore(hn::Set(ints, static_cast<int32_t>(c.object)), isThis, ints,
                       reinterpret_cast<int32_t*>(&out.object[at]));
      hn::BlendedStore(hn::Set(ints, static_cast<int32_t>(c.triangle)), isThis, ints,
                       reinterpret_cast<int32_t*>(&out.triangle[at]));
      const Plain& same = surfaceOf(index);
      if (same.isPlain) {
        const GBuffer::Seen seen(same.surface, c.isFront);
        store(lanes, seen.normal, out.sx, out.sy, out.sz, at);
        store(lanes, seen.geometricNormal, out.gx, out.gy, out.gz, at);
        store(lanes, same.surface.albedo, out.ar, out.ag, out.ab, at);
        store(lanes, seen.emission, out.er, out.eg, out.eb, at);
        continue;
      }
      HWY_ALIGN float u[kLanes], v[kLanes];
      hn::Store(w[1], kTag, u);
      hn::Store(w[2], kTag, v);
      for (uint32_t rest = bits[0]; rest != 0; rest &= rest - 1) {
        const int lane = std::countr_zero(rest);
        const size_t i = at + static_cast<size_t>(lane);
        out.setSurface(i, surfaceAt(scene_, c.object, c.triangle, u[lane], v[lane]), c.isFront);
      }
    }
    out.findFlat(tile, packet);
  }
}

// Usually a packet shows the same surface as before, at another position.
void Raster::writeFlat(const Candidate& c, const Surface& surface, int tile, int packet, int count,
                       GBuffer& out) const {
  const size_t begin = static_cast<size_t>(tile) * kPacketsPerTile + static_cast<size_t>(packet);
  const size_t first = begin * kLanes;
  const Corners corners(scene_, c.object, c.triangle);
  for (int k = 0; k < count; ++k) {
    const size_t at = first + static_cast<size_t>(k) * kLanes;
    Floats w[3];
    c.weights(Pixels(packet + k), w);
    hn::StoreU(corners.at(0, w), kTag, &out.px[at]);
    hn::StoreU(corners.at(1, w), kTag, &out.py[at]);
    hn::StoreU(corners.at(2, w), kTag, &out.pz[at]);
  }
  uint64_t* const names = &out.packetTriangle[begin];
  const bool isNamed = std::all_of(names, names + count, [&](uint64_t n) { return n == c.name(); });
  if (isNamed && out.shows(first, surface, c.isFront)) return;
  out.setSurface(first, surface, c.isFront);
  out.hit[first] = 1;
  out.object[first] = c.object;
  out.triangle[first] = c.triangle;
  const auto fill = [&](auto& v) { std::fill_n(&v[first], count * kLanes, v[first]); };
  for (auto* v : {&out.sx, &out.sy, &out.sz, &out.gx, &out.gy, &out.gz, &out.ar, &out.ag, &out.ab,
                  &out.er, &out.eg, &out.eb})
    fill(*v);
  fill(out.hit);
  fill(out.object);
  fill(out.triangle);
  std::fill_n(&out.isFlat[begin], count, uint8_t{1});
  std::fill_n(names, count, c.name());
}

}  // namespace lamplighter::cpu
