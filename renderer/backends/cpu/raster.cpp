#include "renderer/backends/cpu/raster.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/scene/surface.h"
#include "renderer/wide.h"

namespace lamplighter::cpu {
namespace {

using Tag = hn::FixedTag<float, kLanes>;
using Floats = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;
using IntTag = hn::RebindToSigned<Tag>;
constexpr Tag kTag;
using glm::dvec3;

// Bins of 4×4 tiles, in which triangles are gathered.
constexpr int kBinSize = 4 * kTileSize;
constexpr size_t kTrianglesPerTask = 4096;

// Where the lanes of a packet lie within it.
HWY_ALIGN constexpr float kLaneX[kLanes] = {0, 1, 2, 3, 0, 1, 2, 3};
HWY_ALIGN constexpr float kLaneY[kLanes] = {0, 0, 0, 0, 1, 1, 1, 1};

Floats all(float v) { return hn::Set(kTag, v); }

}  // namespace

// A triangle within a tile. Its edge functions at the pixel (x, y) of the tile are
// atFirst + x·alongX + y·alongY, ≥ 0 within; their sum × inverseDet is 1/distance along the view.
struct Raster::Candidate {
  uint32_t object, triangle;
  bool isFront, isMasked, coversAll;
  int x0, y0, x1, y1;  // pixels of the tile within which it may be
  float atFirst[3], alongX[3], alongY[3];
  float inverseDet;

  Floats edge(int i, Floats x, Floats y) const {
    return hn::MulAdd(all(alongY[i]), y, hn::MulAdd(all(alongX[i]), x, all(atFirst[i])));
  }
};

struct Raster::TileHits {
  HWY_ALIGN float inverseDistance[kTilePixels];
  HWY_ALIGN int32_t candidate[kTilePixels];  // −1: none
  float mostInverse;                         // of the near plane
};

Raster::Raster(const RenderScene& scene, const View& view, vec2 jitter, const GBuffer& size,
               std::span<const uint8_t> wanted)
    : scene_(scene),
      width_(view.width),
      height_(view.height),
      tilesX_(size.tilesX),
      binsX_((view.width + kBinSize - 1) / kBinSize),
      jitter_(jitter),
      eye_(view.eye),
      middleX_(0.5 * view.width),
      middleY_(0.5 * view.height),
      znear_(view.znear) {
  const double pixel = 2.0 * std::tan(0.5 * static_cast<double>(view.yfov)) / view.height;
  right_ = dvec3(view.right()) * (1.0 / pixel);
  down_ = dvec3(view.up()) * (-1.0 / pixel);
  forward_ = dvec3(view.forward());
  const int binsY = (view.height + kBinSize - 1) / kBinSize;
  std::vector<uint8_t> isWanted(static_cast<size_t>(binsX_ * binsY), wanted.empty() ? 1 : 0);
  for (size_t tile = 0; tile < wanted.size(); ++tile) {
    const int x = static_cast<int>(tile) % tilesX_, y = static_cast<int>(tile) / tilesX_;
    if (wanted[tile] != 0)
      isWanted[static_cast<size_t>(y * kTileSize / kBinSize * binsX_ + x * kTileSize / kBinSize)] =
          1;
  }

  // Entries by task, then in the order of triangles by bin.
  const size_t triangles = scene.triangleCount();
  std::vector<std::vector<Entry>> found((triangles + kTrianglesPerTask - 1) / kTrianglesPerTask);
  tbb::parallel_for(size_t{0}, found.size(), [&](size_t task) {
    const size_t first = task * kTrianglesPerTask,
                 last = std::min(first + kTrianglesPerTask, triangles);
    for (uint32_t object = 0; object < scene.objects.size(); ++object) {
      const RenderObject& o = scene.objects[object];
      const size_t begin = o.firstIndex / 3, end = begin + o.triangleCount();
      if (end <= first || begin >= last) continue;
      if (scene.materials[static_cast<size_t>(o.material)].isClear()) continue;
      Entry entry;
      for (size_t i = std::max(begin, first); i < std::min(end, last); ++i)
        if (makeEntry(object, static_cast<uint32_t>(i - begin), entry))
          found[task].push_back(entry);
    }
  });
  const auto forEachBin = [&](const Entry& e, auto&& f) {
    for (int y = e.y0 / kBinSize; y <= e.y1 / kBinSize; ++y)
      for (int x = e.x0 / kBinSize; x <= e.x1 / kBinSize; ++x)
        if (const auto bin = static_cast<size_t>(y * binsX_ + x); isWanted[bin] != 0) f(bin);
  };
  firstOfBin_.assign(isWanted.size() + 1, 0);
  for (const auto& some : found)
    for (const Entry& e : some) forEachBin(e, [&](size_t bin) { ++firstOfBin_[bin + 1]; });
  for (size_t bin = 0; bin < isWanted.size(); ++bin) firstOfBin_[bin + 1] += firstOfBin_[bin];
  entries_.resize(firstOfBin_.back());
  std::vector<uint32_t> next(firstOfBin_.begin(), firstOfBin_.end() - 1);
  for (const auto& some : found)
    for (const Entry& e : some) forEachBin(e, [&](size_t bin) { entries_[next[bin]++] = e; });
}

// x and y: of the image point's distance from the middle × z [pixels], y down; z: distance.
dvec3 Raster::toCamera(uint32_t vertex) const {
  const dvec3 p = dvec3(scene_.positions[vertex]) - eye_;
  return {glm::dot(p, right_), glm::dot(p, down_), glm::dot(p, forward_)};
}

bool Raster::makeEntry(uint32_t object, uint32_t triangle, Entry& out) const {
  const uint32_t* index = &scene_.indices[scene_.objects[object].firstIndex + 3 * triangle];
  const dvec3 a = toCamera(index[0]), b = toCamera(index[1]), c = toCamera(index[2]);
  const double nearest = std::min({a.z, b.z, c.z}), farthest = std::max({a.z, b.z, c.z});
  if (!(farthest > znear_)) return false;
  const double det = glm::dot(a, glm::cross(b, c));
  if (det == 0.0 || !std::isfinite(det)) return false;
  if (det > 0.0 && scene_.backIsUnseen(object)) return false;
  out = {object,
         triangle,
         0,
         0,
         static_cast<uint16_t>(width_ - 1),
         static_cast<uint16_t>(height_ - 1)};
  if (nearest <= 0.5 * znear_) return true;  // reaches behind the eye
  // A pixel more each way, for rounding and jitter.
  const double ax = a.x / a.z, bx = b.x / b.z, cx = c.x / c.z;
  const double ay = a.y / a.z, by = b.y / b.z, cy = c.y / c.z;
  const double x0 = middleX_ + std::min({ax, bx, cx}) - 2.0,
               x1 = middleX_ + std::max({ax, bx, cx}) + 1.0,
               y0 = middleY_ + std::min({ay, by, cy}) - 2.0,
               y1 = middleY_ + std::max({ay, by, cy}) + 1.0;
  if (x1 < 0.0 || y1 < 0.0 || x0 > width_ - 1 || y0 > height_ - 1) return false;
  out.x0 = static_cast<uint16_t>(std::max(x0, 0.0));
  out.y0 = static_cast<uint16_t>(std::max(y0, 0.0));
  out.x1 = static_cast<uint16_t>(std::min<double>(x1, width_ - 1));
  out.y1 = static_cast<uint16_t>(std::min<double>(y1, height_ - 1));
  return true;
}

// Whether the triangle may meet a ray of the tile.
bool Raster::makeCandidate(const Entry& e, int tile, Candidate& out) const {
  const int tx = tile % tilesX_ * kTileSize, ty = tile / tilesX_ * kTileSize;
  constexpr int kLast = kTileSize - 1;
  if (e.x1 < tx || e.y1 < ty || e.x0 > tx + kLast || e.y0 > ty + kLast) return false;
  const uint32_t* index = &scene_.indices[scene_.objects[e.object].firstIndex + 3 * e.triangle];
  const dvec3 corner[3] = {toCamera(index[0]), toCamera(index[1]), toCamera(index[2])};
  // The pixel's ray in these coordinates is (x − middleX, y − middleY, 1).
  const double x = tx + 0.5 + static_cast<double>(jitter_.x) - middleX_;
  const double y = ty + 0.5 + static_cast<double>(jitter_.y) - middleY_;
  const double det = glm::dot(corner[0], glm::cross(corner[1], corner[2]));
  const double sign = det < 0.0 ? -1.0 : 1.0;
  out.coversAll = true;
  for (int i = 0; i < 3; ++i) {
    const dvec3 n = sign * glm::cross(corner[(i + 1) % 3], corner[(i + 2) % 3]);
    out.alongX[i] = static_cast<float>(n.x);
    out.alongY[i] = static_cast<float>(n.y);
    out.atFirst[i] = static_cast<float>(n.x * x + n.y * y + n.z);
    const float toX = kLast * out.alongX[i], toY = kLast * out.alongY[i];
    const float rounding = 1e-5f * (std::abs(out.atFirst[i]) + std::abs(toX) + std::abs(toY));
    if (out.atFirst[i] + std::max(toX, 0.0f) + std::max(toY, 0.0f) < -rounding) return false;
    if (out.atFirst[i] + std::min(toX, 0.0f) + std::min(toY, 0.0f) <= rounding)
      out.coversAll = false;
  }
  const RenderObject& o = scene_.objects[e.object];
  out.object = e.object;
  out.triangle = e.triangle;
  out.isFront = det < 0.0;
  out.isMasked = scene_.materials[static_cast<size_t>(o.material)].alphaMode == AlphaMode::mask;
  out.inverseDet = static_cast<float>(1.0 / std::abs(det));
  out.x0 = std::max(e.x0 - tx, 0);
  out.y0 = std::max(e.y0 - ty, 0);
  out.x1 = std::min(e.x1 - tx, kLast);
  out.y1 = std::min(e.y1 - ty, kLast);
  return true;
}

void Raster::intersect(const Candidate& c, int index, TileHits& hits) const {
  const IntTag ints;
  const Floats most = all(hits.mostInverse), inverseDet = all(c.inverseDet);
  for (int py = c.y0 / kPacketHeight; py <= c.y1 / kPacketHeight; ++py) {
    for (int px = c.x0 / kPacketWidth; px <= c.x1 / kPacketWidth; ++px) {
      const Floats x = hn::Add(hn::Load(kTag, kLaneX), all(static_cast<float>(px * kPacketWidth)));
      const Floats y = hn::Add(hn::Load(kTag, kLaneY), all(static_cast<float>(py * kPacketHeight)));
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

// What is the same all over a triangle, if it is.
struct Plain {
  bool isKnown = false, isPlain = false;
  Surface surface;
};

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
  store(lanes, {all(v.x), all(v.y), all(v.z)}, x, y, z, at);
}

}  // namespace

void Raster::write(std::span<const Candidate> candidates, const TileHits& hits, int tile,
                   GBuffer& out) const {
  std::vector<Plain> plain(candidates.size());
  const auto isFlat = [](const Plain& p) {
    return p.isPlain && p.surface.normal == p.surface.geometricNormal;
  };
  const IntTag ints;
  for (int packet = 0; packet < kPacketsPerTile; ++packet) {
    const size_t in = static_cast<size_t>(packet) * kLanes,
                 at = static_cast<size_t>(tile) * kTilePixels + in;
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
    const Floats x = hn::Add(hn::Load(kTag, kLaneX),
                             all(static_cast<float>(packet % kPacketsPerRow * kPacketWidth)));
    const Floats y = hn::Add(hn::Load(kTag, kLaneY),
                             all(static_cast<float>(packet / kPacketsPerRow * kPacketHeight)));
    while (left != 0) {
      const int index = hits.candidate[in + static_cast<size_t>(std::countr_zero(left))];
      const Candidate& c = candidates[static_cast<size_t>(index)];
      const auto isThis = hn::Eq(which, hn::Set(ints, index));
      const Mask lanes = hn::RebindMask(kTag, isThis);
      uint8_t bits[8];
      hn::StoreMaskBits(kTag, lanes, bits);
      left &= ~uint32_t{bits[0]};
      const Floats e[3] = {c.edge(0, x, y), c.edge(1, x, y), c.edge(2, x, y)};
      const Floats scale = hn::Div(all(1.0f), hn::Add(hn::Add(e[0], e[1]), e[2]));
      const Floats w[3] = {hn::Mul(e[0], scale), hn::Mul(e[1], scale), hn::Mul(e[2], scale)};
      const uint32_t* corner =
          &scene_.indices[scene_.objects[c.object].firstIndex + 3 * c.triangle];
      Floats p[3];
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = hn::Mul(w[0], all(scene_.positions[corner[0]][axis]));
        p[axis] = hn::MulAdd(w[1], all(scene_.positions[corner[1]][axis]), p[axis]);
        p[axis] = hn::MulAdd(w[2], all(scene_.positions[corner[2]][axis]), p[axis]);
      }
      store(lanes, p, out.px, out.py, out.pz, at);
      hn::BlendedStore(hn::Set(ints, static_cast<int32_t>(c.object)), isThis, ints,
                       reinterpret_cast<int32_t*>(&out.object[at]));
      hn::BlendedStore(hn::Set(ints, static_cast<int32_t>(c.triangle)), isThis, ints,
                       reinterpret_cast<int32_t*>(&out.triangle[at]));
      Plain& same = plain[static_cast<size_t>(index)];
      if (!same.isKnown) {
        same.isKnown = true;
        same.isPlain = isPlain(scene_, c.object, c.triangle);
        if (same.isPlain) same.surface = surfaceAt(scene_, c.object, c.triangle, 0.25f, 0.25f);
      }
      const float side = c.isFront ? 1.0f : -1.0f;
      const auto emission = [&](const Surface& s) {
        return c.isFront || s.emitsBothSides ? s.emission : vec3(0.0f);
      };
      if (same.isPlain) {
        const Surface& s = same.surface;
        store(lanes, side * s.normal, out.sx, out.sy, out.sz, at);
        store(lanes, side * s.geometricNormal, out.gx, out.gy, out.gz, at);
        store(lanes, s.albedo, out.ar, out.ag, out.ab, at);
        store(lanes, emission(s), out.er, out.eg, out.eb, at);
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
    const int first = hits.candidate[in];
    if (first >= 0 && hn::AllTrue(ints, hn::Eq(which, hn::Set(ints, first))) &&
        isFlat(plain[static_cast<size_t>(first)])) {
      out.isFlat[at / kLanes] = 1;
      continue;
    }
    out.findFlat(tile, packet);
  }
  const int first = hits.candidate[0];
  const bool isOnly =
      first >= 0 && isFlat(plain[static_cast<size_t>(first)]) &&
      std::all_of(hits.candidate, hits.candidate + kTilePixels, [&](int c) { return c == first; });
  const Candidate* only = isOnly ? &candidates[static_cast<size_t>(first)] : nullptr;
  out.onlyTriangle[static_cast<size_t>(tile)] =
      only == nullptr ? GBuffer::kMany : uint64_t{only->object} << 32 | only->triangle;
}

void Raster::trace(int tile, GBuffer& out) const {
  const int tx = tile % tilesX_ * kTileSize, ty = tile / tilesX_ * kTileSize;
  TileHits hits;
  std::fill_n(hits.inverseDistance, kTilePixels, 0.0f);
  std::fill_n(hits.candidate, kTilePixels, -1);
  hits.mostInverse = static_cast<float>(1.0 / znear_);
  const auto bin = static_cast<size_t>(ty / kBinSize * binsX_ + tx / kBinSize);
  std::vector<Candidate> candidates;
  Candidate candidate;
  for (uint32_t i = firstOfBin_[bin]; i < firstOfBin_[bin + 1]; ++i) {
    if (!makeCandidate(entries_[i], tile, candidate)) continue;
    intersect(candidate, static_cast<int>(candidates.size()), hits);
    candidates.push_back(candidate);
  }
  // What is past the image's edge is a miss.
  if (tx + kTileSize > width_ || ty + kTileSize > height_) {
    for (int i = 0; i < kTilePixels; ++i) {
      const int packet = i / kLanes, lane = i % kLanes;
      const int x = tx + packet % kPacketsPerRow * kPacketWidth + lane % kPacketWidth;
      const int y = ty + packet / kPacketsPerRow * kPacketHeight + lane / kPacketWidth;
      if (x >= width_ || y >= height_) hits.candidate[i] = -1;
    }
  }
  write(candidates, hits, tile, out);
}

}  // namespace lamplighter::cpu
