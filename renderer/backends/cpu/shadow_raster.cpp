#include "renderer/backends/cpu/shadow_raster.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "renderer/backends/cpu/shadow_maps.h"
#include "renderer/wide.h"

namespace lamplighter::cpu {
namespace {

constexpr size_t kLanes = 8;
using Tag = hn::FixedTag<float, kLanes>;
using HalfTag = hn::FixedTag<float, kLanes / 2>;
using Floats = hn::Vec<Tag>;
constexpr Tag kTag;
constexpr HalfTag kHalfTag;

// Above these rays are faster: triangles of an object, of all, and objects that are left to rays.
constexpr uint32_t kMostOfObject = 64;
constexpr size_t kMostTriangles = 1024, kMostComplex = 64;
// As are they where this share of blocks is left to them.
constexpr float kMostOfBlocks = 0.75f;

constexpr int kLeastTile = 2 * kBlockWidth;
constexpr int kMostTiles = 16;  // on a side
constexpr size_t kRow = TexelDirections::kCornersARow;
static_assert(kRow >= kMostTiles + kLanes);

Floats all(float v) { return hn::Set(kTag, v); }
Floats load(const std::vector<float>& v, size_t at) { return hn::LoadU(kTag, &v[at]); }

// A map's rows are four texels of a block's upper row, and of its lower one.
Floats loadBlock(const float* map, size_t resolution) {
  return hn::Combine(kTag, hn::LoadU(kHalfTag, map + resolution), hn::LoadU(kHalfTag, map));
}
void storeBlock(Floats v, float* map, size_t resolution) {
  hn::StoreU(hn::LowerHalf(kHalfTag, v), kHalfTag, map);
  hn::StoreU(hn::UpperHalf(kHalfTag, v), kHalfTag, map + resolution);
}

// What is linear in a ray's direction.
struct Function {
  Floats x, y, z;
  Function(const float (&f)[4][kLanes], size_t lane)
      : x(all(f[0][lane])), y(all(f[1][lane])), z(all(f[2][lane])) {}
  Floats at(Floats dx, Floats dy, Floats dz) const {
    return hn::MulAdd(x, dx, hn::MulAdd(y, dy, hn::Mul(z, dz)));
  }
};

// Within it a, b and c are no less than 0.
struct Triangle {
  Function a, b, c, stored;
  Triangle(const ShadowTriangles::Batch& batch, size_t lane)
      : a(batch.functions[0], lane),
        b(batch.functions[1], lane),
        c(batch.functions[2], lane),
        stored(batch.functions[ShadowTriangles::Batch::kPlane], lane) {}
};

struct Ends {
  Floats least, most;
};
Ends both(const Ends& a, const Ends& b) {
  return {hn::Min(a.least, b.least), hn::Max(a.most, b.most)};
}

// Of the functions at the corners of eight tiles in a row, on one side of them.
struct AtCorners {
  Ends a, b, c, stored;
  AtCorners(const Triangle& t, const TexelDirections& d, int row, int first) {
    const size_t at = static_cast<size_t>(row) * kRow + static_cast<size_t>(first);
    const Floats x0 = load(d.cornerX, at), x1 = load(d.cornerX, at + 1);
    const Floats y0 = load(d.cornerY, at), y1 = load(d.cornerY, at + 1);
    const Floats z0 = load(d.cornerZ, at), z1 = load(d.cornerZ, at + 1);
    const auto ends = [&](const Function& f) {
      const Floats left = f.at(x0, y0, z0), right = f.at(x1, y1, z1);
      return Ends{hn::Min(left, right), hn::Max(left, right)};
    };
    a = ends(t.a);
    b = ends(t.b);
    c = ends(t.c);
    stored = ends(t.stored);
  }
};

// Draws into columns [x, x + width) of rows [y, end). The least that is stored there then.
template <bool isWhole>
float drawTile(const Triangle& t, const TexelDirections& d, Floats most, int x, int width, int y,
               int end, int resolution, float* map) {
  Floats least = most;
  const auto stride = static_cast<size_t>(resolution);
  const int across = resolution / kBlockWidth;
  for (; y < end; y += kBlockHeight) {
    size_t at = kLanes * static_cast<size_t>(y / kBlockHeight * across + x / kBlockWidth);
    float* texels = map + static_cast<size_t>(y) * stride + static_cast<size_t>(x);
    for (const float* const last = texels + width; texels < last;
         texels += kBlockWidth, at += kLanes) {
      const Floats dx = load(d.x, at), dy = load(d.y, at), dz = load(d.z, at);
      const Floats stored = t.stored.at(dx, dy, dz);
      auto isMet = hn::Le(stored, most);
      if (!isWhole)
        isMet = hn::And(isMet, hn::Ge(hn::Min(hn::Min(t.a.at(dx, dy, dz), t.b.at(dx, dy, dz)),
                                              t.c.at(dx, dy, dz)),
                                      hn::Zero(kTag)));
      const Floats nearest = hn::Max(hn::IfThenElseZero(isMet, stored), loadBlock(texels, stride));
      storeBlock(nearest, texels, stride);
      least = hn::Min(least, nearest);
    }
  }
  return hn::GetLane(hn::MinOfLanes(kTag, least));
}

}  // namespace

// Rows that are rendered at once, while what they read and write fits the first-level cache.
struct ShadowRaster::Band {
  int firstRow, lastRow;
  int firstTile, lastTile;     // rows of tiles that they reach into
  std::vector<uint8_t> marks;  // by block: it is left to rays
  // By tile: no less is stored in any of its texels in these rows.
  alignas(32) float least[kBand / kLeastTile][kRow] = {};

  Band(int first, int last, int tile)
      : firstRow(first),
        lastRow(last),
        firstTile(first / tile),
        lastTile((last + tile - 1) / tile) {}
  // Of a row of tiles, as far as it is in here.
  int top(int row, int tile) const { return std::max(firstRow, row * tile); }
  int bottom(int row, int tile) const { return std::min(lastRow, (row + 1) * tile); }
};

void ShadowRaster::setScene(const RenderScene& scene) {
  complex_.clear();
  std::vector<ShadowTriangles::Corners> triangles;
  for (const RenderObject& o : scene.objects) {
    const Material& material = scene.materials[static_cast<size_t>(o.material)];
    if (material.isClear()) continue;
    if (o.triangleCount() > kMostOfObject || material.alphaMode == AlphaMode::mask) {
      complex_.push_back({o.bounds.centre(), o.bounds.radius()});
      continue;
    }
    const uint32_t* const index = &scene.indices[o.firstIndex];
    for (uint32_t i = 0; i < o.indexCount; i += 3)
      triangles.push_back({scene.positions[index[i]], scene.positions[index[i + 1]],
                           scene.positions[index[i + 2]]});
    if (triangles.size() > kMostTriangles) break;
  }
  isUseful_ = triangles.size() <= kMostTriangles && complex_.size() <= kMostComplex;
  triangles_.set(isUseful_ ? std::move(triangles) : std::vector<ShadowTriangles::Corners>());
}

void ShadowRaster::setResolution(int resolution) {
  if (resolution == resolution_) return;
  resolution_ = resolution;
  tile_ = kLeastTile;
  while (resolution > tile_ * kMostTiles) tile_ *= 2;
  // Tiles' corners lie on the creases of the octahedron, so that directions are linear on either
  // side of a tile's diagonal.
  if (resolution % tile_ != 0) tile_ = 0;
  if (tile_ == 0) return;
  tiles_ = resolution / tile_;
  hemisphere_ = texelDirections(resolution, tile_, false);
  parallel_ = texelDirections(resolution, tile_, true);
}

// Marks blocks that may see what is left to rays. Whether rasterising the others is worth it.
bool ShadowRaster::markForRays(const LightSpace& light, Band& band) const {
  const TexelDirections& d = directions(light);
  const auto across = static_cast<size_t>(resolution_ / kBlockWidth);
  const size_t first = static_cast<size_t>(band.firstRow / kBlockHeight) * across,
               count = static_cast<size_t>((band.lastRow - band.firstRow) / kBlockHeight) * across;
  std::vector<uint8_t>& marks = band.marks;
  marks.assign(count, 0);
  for (const Sphere& sphere : complex_) {
    const vec3 way = sphere.centre - light.origin;
    const vec3 c(glm::dot(way, light.axes[0]), glm::dot(way, light.axes[1]),
                 glm::dot(way, light.axes[2]));
    const float distance = glm::length(c);
    if (!light.isParallel && c.z < -sphere.radius) continue;
    if (!light.isParallel && distance <= sphere.radius) return false;
    // Within this angle of the middle: rounding is far less than the slack.
    const float sine = sphere.radius / distance * 1.001f + 1e-4f;
    if (!light.isParallel && sine >= 1.0f) return false;
    const float cosine = std::sqrt(1.0f - std::min(1.0f, sine * sine));
    const vec3 unit = c / distance;
    const float reach = sphere.radius * light.across * 1.001f + 1e-4f;
    for (size_t i = 0; i < count; i += kLanes) {
      const Floats x = load(d.midX, first + i), y = load(d.midY, first + i);
      auto meets = hn::Eq(x, x);
      if (light.isParallel) {
        const Floats dx = hn::Sub(x, all(c.x * light.across)),
                     dy = hn::Sub(y, all(c.y * light.across)),
                     most = hn::Add(load(d.cosine, first + i), all(reach));
        meets = hn::Le(hn::MulAdd(dx, dx, hn::Mul(dy, dy)), hn::Mul(most, most));
      } else {
        const Floats cosines =
            hn::MulAdd(x, all(unit.x),
                       hn::MulAdd(y, all(unit.y), hn::Mul(load(d.midZ, first + i), all(unit.z))));
        // Both angles are less than a right one: cos(a + b) falls from 1 to −1.
        const Floats least = hn::Sub(hn::Mul(load(d.cosine, first + i), all(cosine)),
                                     hn::Mul(load(d.sine, first + i), all(sine)));
        meets = hn::Ge(cosines, least);
      }
      for (uint32_t rest = bitsOf(meets); rest != 0; rest &= rest - 1)
        marks[i + static_cast<size_t>(std::countr_zero(rest))] = 1;
    }
  }
  const auto marked = static_cast<float>(std::count(marks.begin(), marks.end(), 1));
  return marked <= kMostOfBlocks * static_cast<float>(count);
}

// Where all blocks of a tile are left to rays nothing is nearer than what is there.
void ShadowRaster::passOverMarked(Band& band) const {
  const int across = resolution_ / kBlockWidth;
  for (int ty = band.firstTile; ty < band.lastTile; ++ty) {
    for (int tx = 0; tx < tiles_; ++tx) {
      bool isMarked = true;
      for (int y = band.top(ty, tile_); y < band.bottom(ty, tile_); y += kBlockHeight)
        for (int x = tx * tile_; x < (tx + 1) * tile_; x += kBlockWidth)
          isMarked = isMarked &&
                     band.marks[static_cast<size_t>((y - band.firstRow) / kBlockHeight * across +
                                                    x / kBlockWidth)] != 0;
      if (isMarked) band.least[ty - band.firstTile][tx] = std::numeric_limits<float>::infinity();
    }
  }
}

void ShadowRaster::draw(const ShadowTriangles::Batch& batch, size_t lane, const LightSpace& light,
                        Band& band, std::span<float> map) const {
  const TexelDirections& d = directions(light);
  const Triangle t(batch, lane);
  const auto slack = [&](size_t function) { return all(batch.functions[function][3][lane]); };
  const Floats slackA = slack(0), slackB = slack(1), slackC = slack(2);
  // The tile in the middle of an odd number of them has the tip of the octahedron between its
  // corners: what is stored there may be more than at these.
  const Floats slackStored = tiles_ % 2 == 0 ? slack(ShadowTriangles::Batch::kPlane)
                                             : all(std::numeric_limits<float>::infinity());
  const Floats zero = hn::Zero(kTag), most = all(light.most);
  for (int first = 0; first < tiles_; first += static_cast<int>(kLanes)) {
    const uint32_t lanes = (1u << std::min(tiles_ - first, static_cast<int>(kLanes))) - 1;
    AtCorners above(t, d, band.firstTile, first);
    for (int ty = band.firstTile; ty < band.lastTile; ++ty) {
      const AtCorners below(t, d, ty + 1, first);
      float* const least = &band.least[ty - band.firstTile][first];
      const Ends a = both(above.a, below.a), b = both(above.b, below.b), c = both(above.c, below.c),
                 stored = both(above.stored, below.stored);
      above = below;
      const auto isMet = hn::And(
          hn::And(hn::Ge(hn::Add(a.most, slackA), zero), hn::Ge(hn::Add(b.most, slackB), zero)),
          hn::And(hn::Ge(hn::Add(c.most, slackC), zero),
                  hn::Gt(hn::Add(stored.most, slackStored), hn::Load(kTag, least))));
      const uint32_t met = bitsOf(isMet) & lanes;
      if (met == 0) continue;
      const uint32_t whole = bitsOf(hn::And(
          hn::And(hn::Gt(a.least, slackA), hn::Gt(b.least, slackB)), hn::Gt(c.least, slackC)));
      for (uint32_t rest = met; rest != 0; rest &= rest - 1) {
        const int tx = std::countr_zero(rest);
        const auto draw = (whole >> tx & 1) != 0 ? drawTile<true> : drawTile<false>;
        least[tx] = draw(t, d, most, (first + tx) * tile_, tile_, band.top(ty, tile_),
                         band.bottom(ty, tile_), resolution_, map.data());
      }
    }
  }
}

uint64_t ShadowRaster::render(const RayCaster& rays, const shared::Vpl& vpl, int firstRow,
                              int lastRow, std::span<float> map) const {
  if (!isUseful_ || tile_ == 0)
    return traceShadowMap(rays, vpl, resolution_, firstRow, lastRow, map);
  const LightSpace light(vpl);
  std::vector<ShadowTriangles::Batch> batches;
  uint64_t cast = 0;
  for (int row = firstRow; row < lastRow; row += kBand) {
    Band band(row, std::min(row + kBand, lastRow), tile_);
    if (!markForRays(light, band)) {
      cast += traceShadowMap(rays, vpl, resolution_, row, band.lastRow, map);
      continue;
    }
    if (batches.empty()) {
      batches.resize(triangles_.batches());
      triangles_.see(light, batches);
    }
    passOverMarked(band);
    const auto across = static_cast<std::ptrdiff_t>(resolution_);
    std::fill(map.begin() + row * across, map.begin() + band.lastRow * across, 0.0f);
    for (const ShadowTriangles::Batch& batch : batches)
      for (uint32_t rest = batch.lanes; rest != 0; rest &= rest - 1)
        draw(batch, static_cast<size_t>(std::countr_zero(rest)), light, band, map);
    cast += traceShadowMap(rays, vpl, resolution_, row, band.lastRow, map, band.marks);
  }
  return cast;
}

}  // namespace lamplighter::cpu
