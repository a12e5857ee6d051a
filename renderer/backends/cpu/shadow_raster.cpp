// x86-64-v3 has no AES instructions, which Highway wants of its AVX2 target unless told otherwise.
#define HWY_DISABLE_PCLMUL_AES 1

#include "renderer/backends/cpu/shadow_raster.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <hwy/highway.h>

#include "renderer/backends/cpu/shadow_maps.h"

namespace lamplighter::cpu {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
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

constexpr int kMostTiles = 16;  // on a side
constexpr size_t kRow = TexelDirections::kCornersARow;
static_assert(kRow >= kMostTiles + kLanes);

// Of an edge's function: what it may be wrong by, so that neighbours do not both leave a tile out.
constexpr float kRounding = 1e-6f;

Floats all(float v) { return hn::Set(kTag, v); }
Floats load(const std::vector<float>& v, size_t at) { return hn::LoadU(kTag, &v[at]); }

struct Wide {
  Floats x, y, z;
};
Wide operator-(const Wide& a, const Wide& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
Floats dot(const Wide& a, const Wide& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
// Exactly that of (b, a) but for the sign: neighbours agree on the edge that they share.
Wide cross(const Wide& a, const Wide& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
Wide operator*(const Wide& a, Floats s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}

// A map's rows are four texels of a block's upper row, and of its lower one.
Floats loadBlock(const float* map, size_t resolution) {
  return hn::Combine(kTag, hn::LoadU(kHalfTag, map + resolution), hn::LoadU(kHalfTag, map));
}
void storeBlock(Floats v, float* map, size_t resolution) {
  hn::StoreU(hn::LowerHalf(kHalfTag, v), kHalfTag, map);
  hn::StoreU(hn::UpperHalf(kHalfTag, v), kHalfTag, map + resolution);
}

}  // namespace

struct ShadowRaster::Light {
  bool isParallel;
  vec3 origin;
  mat3 axes;         // columns: those of light space
  float across, up;  // what light space is scaled by; 1 but for parallel lights
  float most;        // of what is stored: at the nearest that a ray meets
  const TexelDirections& directions;

  Light(const ShadowRaster& raster, const shared::Vpl& vpl)
      : isParallel(vpl.position.w == shared::kVplDirectional),
        origin(vpl.position),
        axes(vec3(vpl.tangent), glm::cross(vec3(vpl.normal), vec3(vpl.tangent)), vec3(vpl.normal)),
        across(isParallel ? 1.0f / vpl.tangent.w : 1.0f),
        up(isParallel ? 0.5f / vpl.normal.w : 1.0f),
        most(isParallel ? 1.0f : 1.0f / rayEpsilon(origin)),
        directions(isParallel ? raster.parallel_ : raster.hemisphere_) {}

  // Of parallel light z is what is stored: 1 a radius over the origin, 0 under it.
  Wide toLight(const Wide& p) const {
    const Wide way = p - Wide{all(origin.x), all(origin.y), all(origin.z)};
    const auto along = [&](int axis, float scale) {
      const vec3 a = axes[axis] * scale;
      return dot(way, {all(a.x), all(a.y), all(a.z)});
    };
    const Floats z = along(2, up);
    return {along(0, across), along(1, across), isParallel ? hn::Add(z, all(0.5f)) : z};
  }
};

struct ShadowRaster::Triangle {
  std::array<vec3, 3> edges;  // d·edge ≥ 0 within
  std::array<float, 3> slack;
  vec3 plane{0.0f};  // d·plane: what is stored
};

struct ShadowRaster::Batch {
  std::array<Triangle, kLanes> triangles;
  uint32_t lanes = 0;  // a bit for each that may be seen
};

void ShadowRaster::setScene(const RenderScene& scene) {
  complex_.clear();
  for (auto& corner : corners_)
    for (auto& axis : corner) axis.clear();
  triangles_ = 0;
  for (const RenderObject& o : scene.objects) {
    const Material& material = scene.materials[static_cast<size_t>(o.material)];
    if (material.isClear()) continue;
    if (o.triangleCount() > kMostOfObject || material.alphaMode == AlphaMode::mask) {
      complex_.push_back({o.bounds.centre(), o.bounds.radius()});
      continue;
    }
    triangles_ += o.triangleCount();
    for (uint32_t i = 0; i < o.indexCount; ++i) {
      const vec3& p = scene.positions[scene.indices[o.firstIndex + i]];
      for (int axis = 0; axis < 3; ++axis)
        corners_[i % 3][static_cast<size_t>(axis)].push_back(p[axis]);
    }
    if (triangles_ > kMostTriangles) break;
  }
  isUseful_ = triangles_ <= kMostTriangles && complex_.size() <= kMostComplex;
  // Whole vectors: the last are points, which are never seen.
  const size_t padded = (triangles_ + kLanes - 1) / kLanes * kLanes;
  for (auto& corner : corners_)
    for (auto& axis : corner) axis.resize(padded, 0.0f);
}

void ShadowRaster::setResolution(int resolution) {
  if (resolution == resolution_) return;
  resolution_ = resolution;
  tile_ = kBlockWidth * 2;
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
bool ShadowRaster::markForRays(const Light& light, int firstRow, int lastRow,
                               std::vector<uint8_t>& marks) const {
  const TexelDirections& d = light.directions;
  const size_t first = static_cast<size_t>(firstRow / kBlockHeight * (resolution_ / kBlockWidth)),
               count = static_cast<size_t>((lastRow - firstRow) / kBlockHeight) *
                       static_cast<size_t>(resolution_ / kBlockWidth);
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
      uint8_t bits[8];
      hn::StoreMaskBits(kTag, meets, bits);
      for (uint32_t rest = bits[0]; rest != 0; rest &= rest - 1)
        marks[i + static_cast<size_t>(std::countr_zero(rest))] = 1;
    }
  }
  const auto marked = static_cast<float>(std::count(marks.begin(), marks.end(), 1));
  return marked <= kMostOfBlocks * static_cast<float>(count);
}

void ShadowRaster::prepare(const Light& light, size_t first, Batch& out) const {
  std::array<Wide, 3> corner;
  for (size_t i = 0; i < 3; ++i)
    corner[i] = light.toLight(
        {load(corners_[i][0], first), load(corners_[i][1], first), load(corners_[i][2], first)});
  const auto& [a, b, c] = corner;
  const Wide normal = cross(b - a, c - a);
  std::array<Wide, 3> flat = corner;  // as the rays see them: of parallel ones z is 1
  if (light.isParallel)
    for (Wide& p : flat) p.z = all(1.0f);
  const Floats det = light.isParallel ? normal.z : dot(a, normal);
  const Floats inverse = hn::Div(all(1.0f), det);
  // Of parallel light: a.z − ((u − a.x) n.x + (v − a.y) n.y) / n.z.
  const Wide slope = normal * inverse;
  const Wide plane = light.isParallel
                         ? Wide{hn::Neg(slope.x), hn::Neg(slope.y),
                                hn::MulAdd(slope.x, a.x, hn::MulAdd(slope.y, a.y, a.z))}
                         : slope;
  auto isSeen = hn::And(hn::Lt(hn::Abs(inverse), all(std::numeric_limits<float>::max())),
                        hn::Ne(det, hn::Zero(kTag)));
  if (!light.isParallel)
    isSeen = hn::And(isSeen, hn::Gt(hn::Max(a.z, hn::Max(b.z, c.z)), hn::Zero(kTag)));
  uint8_t bits[8];
  hn::StoreMaskBits(kTag, isSeen, bits);
  out.lanes = bits[0];
  if (out.lanes == 0) return;
  const Floats side = hn::CopySign(all(1.0f), det);
  const auto store = [&](const Wide& v, auto&& member) {
    HWY_ALIGN float x[kLanes], y[kLanes], z[kLanes];
    hn::Store(v.x, kTag, x);
    hn::Store(v.y, kTag, y);
    hn::Store(v.z, kTag, z);
    for (size_t lane = 0; lane < kLanes; ++lane)
      member(out.triangles[lane]) = vec3(x[lane], y[lane], z[lane]);
  };
  for (size_t i = 0; i < 3; ++i) {
    store(cross(flat[(i + 1) % 3], flat[(i + 2) % 3]) * side,
          [&](Triangle& t) -> vec3& { return t.edges[i]; });
    for (Triangle& t : out.triangles) {
      const vec3 size = glm::abs(t.edges[i]);
      t.slack[i] = -kRounding * (size.x + size.y + size.z);
    }
  }
  store(plane, [](Triangle& t) -> vec3& { return t.plane; });
}

void ShadowRaster::draw(const Triangle& t, const TexelDirections& d, float most, int firstRow,
                        int lastRow, std::span<float> map) const {
  const auto along = [](const vec3& n, Floats x, Floats y, Floats z) {
    return hn::MulAdd(all(n.x), x, hn::MulAdd(all(n.y), y, hn::Mul(all(n.z), z)));
  };
  const auto resolution = static_cast<size_t>(resolution_);
  // Of the edges' functions at the corners of tiles: in the row above and in the one below.
  using Row = std::array<std::array<float, kRow>, 3>;
  Row rows[2];
  const auto fillRow = [&](int y, Row& row) {
    const size_t at = static_cast<size_t>(y) * kRow;
    // As far as the tiles' last vector reads, and one more.
    for (size_t i = 0; i <= kLanes * ((static_cast<size_t>(tiles_) + kLanes - 1) / kLanes);
         i += kLanes) {
      const Floats dx = load(d.cornerX, at + i), dy = load(d.cornerY, at + i),
                   dz = load(d.cornerZ, at + i);
      for (size_t e = 0; e < 3; ++e) hn::StoreU(along(t.edges[e], dx, dy, dz), kTag, &row[e][i]);
    }
  };
  const int firstTile = firstRow / tile_, lastTile = (lastRow + tile_ - 1) / tile_;
  fillRow(firstTile, rows[0]);
  for (int ty = firstTile; ty < lastTile; ++ty) {
    const Row &above = rows[(ty - firstTile) % 2], &below = rows[(ty - firstTile + 1) % 2];
    fillRow(ty + 1, rows[(ty - firstTile + 1) % 2]);
    for (size_t tx0 = 0; tx0 < static_cast<size_t>(tiles_); tx0 += kLanes) {
      auto isMet = hn::Eq(all(0.0f), all(0.0f)), isInside = isMet;
      for (size_t e = 0; e < 3; ++e) {
        const Floats c0 = hn::LoadU(kTag, &above[e][tx0]), c1 = hn::LoadU(kTag, &below[e][tx0]),
                     c2 = hn::LoadU(kTag, &above[e][tx0 + 1]),
                     c3 = hn::LoadU(kTag, &below[e][tx0 + 1]);
        isMet = hn::And(isMet, hn::Ge(hn::Max(hn::Max(c0, c1), hn::Max(c2, c3)), all(t.slack[e])));
        isInside =
            hn::And(isInside, hn::Gt(hn::Min(hn::Min(c0, c1), hn::Min(c2, c3)), all(-t.slack[e])));
      }
      uint8_t met[8], inside[8];
      hn::StoreMaskBits(kTag, isMet, met);
      hn::StoreMaskBits(kTag, isInside, inside);
      for (uint32_t rest = met[0]; rest != 0; rest &= rest - 1) {
        const int lane = std::countr_zero(rest), tx = static_cast<int>(tx0) + lane;
        if (tx >= tiles_) break;
        const bool isWhole = (inside[0] >> lane & 1) != 0;
        for (int y = std::max(firstRow, ty * tile_); y < std::min(lastRow, (ty + 1) * tile_);
             y += kBlockHeight) {
          for (int x = tx * tile_; x < (tx + 1) * tile_; x += kBlockWidth) {
            const size_t at =
                kLanes * static_cast<size_t>(y / kBlockHeight * (resolution_ / kBlockWidth) +
                                             x / kBlockWidth);
            const Floats dx = load(d.x, at), dy = load(d.y, at), dz = load(d.z, at);
            float* const texels =
                &map[static_cast<size_t>(y) * resolution + static_cast<size_t>(x)];
            const Floats last = loadBlock(texels, resolution), stored = along(t.plane, dx, dy, dz);
            auto isNearer = hn::And(hn::Gt(stored, last), hn::Le(stored, all(most)));
            if (!isWhole)
              for (const vec3& edge : t.edges)
                isNearer = hn::And(isNearer, hn::Ge(along(edge, dx, dy, dz), hn::Zero(kTag)));
            storeBlock(hn::IfThenElse(isNearer, stored, last), texels, resolution);
          }
        }
      }
    }
  }
}

uint64_t ShadowRaster::render(const RayCaster& rays, const shared::Vpl& vpl, int firstRow,
                              int lastRow, std::span<float> map) const {
  const auto texels =
      static_cast<uint64_t>(resolution_) * static_cast<uint64_t>(lastRow - firstRow);
  std::vector<uint8_t> marks;
  const Light light(*this, vpl);
  if (!isUseful_ || tile_ == 0 || !markForRays(light, firstRow, lastRow, marks)) {
    traceShadowMap(rays, vpl, resolution_, firstRow, lastRow, map);
    return texels;
  }
  const auto first = static_cast<size_t>(firstRow) * static_cast<size_t>(resolution_);
  std::fill_n(map.begin() + static_cast<std::ptrdiff_t>(first), texels, 0.0f);
  Batch batch;
  for (size_t i = 0; i < triangles_; i += kLanes) {
    prepare(light, i, batch);
    for (uint32_t rest = batch.lanes; rest != 0; rest &= rest - 1)
      draw(batch.triangles[static_cast<size_t>(std::countr_zero(rest))], light.directions,
           light.most, firstRow, lastRow, map);
  }
  return traceShadowMap(rays, vpl, resolution_, firstRow, lastRow, map, marks);
}

}  // namespace lamplighter::cpu
