#include "renderer/backends/cpu/shadow_maps/shadow_raster.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "renderer/backends/cpu/shadow_maps/shadow_maps.h"
#include "renderer/base/simd.h"

namespace lamplighter::cpu {
namespace {

constexpr size_t kTriangles = ShadowTriangles::kLanes;
static_assert(kTriangles == hn::MaxLanes(kTag));
using HalfTag = hn::FixedTag<float, kTriangles / 2>;
using Floats = Floats8;
constexpr HalfTag kHalfTag;

// Above these limits rays are faster: triangles per object, triangles in total, and the number of
// traced objects.
constexpr uint32_t kMostOfObject = 64;
constexpr size_t kMostTriangles = 1024, kMostComplex = 64;
// Rays are also faster if at least this share of the blocks needs them.
constexpr float kMostOfBlocks = 0.75f;

constexpr int kLeastTile = 2 * kBlockWidth;
constexpr int kMostTiles = 16;  // per side
constexpr size_t kRow = TexelDirections::kCornersARow;
static_assert(kRow >= kMostTiles + kTriangles);

// An object's triangles are split into runs of consecutive indices, which are usually close
// together.
constexpr uint32_t kMostParts = 32, kLeastOfPart = 16;

std::vector<Sphere> partsOfMesh(const RenderScene& scene, const RenderObject& o) {
  const uint32_t parts = std::clamp(o.triangleCount() / kLeastOfPart, 1u, kMostParts);
  std::vector<Sphere> spheres;
  for (uint32_t i = 0; i < parts; ++i) {
    Bounds box;
    const uint32_t first = o.triangleCount() * i / parts, end = o.triangleCount() * (i + 1) / parts;
    for (uint32_t k = 3 * first; k < 3 * end; ++k)
      box.add(scene.positions[scene.indices[o.firstIndex + k]]);
    spheres.push_back({box.centre(), box.radius()});
  }
  return spheres;
}

// A vector holds four texels of a block's upper row, then four of its lower row.
Floats loadBlock(const float* map, size_t resolution) {
  return hn::Combine(kTag, hn::LoadU(kHalfTag, map + resolution), hn::LoadU(kHalfTag, map));
}
void storeBlock(Floats v, float* map, size_t resolution) {
  hn::StoreU(hn::LowerHalf(kHalfTag, v), kHalfTag, map);
  hn::StoreU(hn::UpperHalf(kHalfTag, v), kHalfTag, map + resolution);
}

// A linear function of the ray direction.
struct Function {
  Floats x, y, z;
  Function(const float (&f)[4][kTriangles], size_t lane)
      : x(broadcast(f[0][lane])), y(broadcast(f[1][lane])), z(broadcast(f[2][lane])) {}
  Floats at(Floats dx, Floats dy, Floats dz) const {
    return hn::MulAdd(x, dx, hn::MulAdd(y, dy, hn::Mul(z, dz)));
  }
};

// Inside the triangle a, b and c are ≥ 0.
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

// Values of the functions at the corners of eight adjacent tiles, on one side of the tiles.
struct AtCorners {
  Ends a, b, c, stored;
  AtCorners(const Triangle& t, const TexelDirections& d, int row, int first) {
    const size_t at = static_cast<size_t>(row) * kRow + static_cast<size_t>(first);
    const Floats x0 = loadAt(d.cornerX, at), x1 = loadAt(d.cornerX, at + 1);
    const Floats y0 = loadAt(d.cornerY, at), y1 = loadAt(d.cornerY, at + 1);
    const Floats z0 = loadAt(d.cornerZ, at), z1 = loadAt(d.cornerZ, at + 1);
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

// Draws into columns [x, x + width) of rows [y, end). Returns the smallest value stored there
// afterwards.
template <bool isWhole>
float drawTile(const Triangle& t, const TexelDirections& d, Floats most, int x, int width, int y,
               int end, int resolution, float* map) {
  Floats least = most;
  const auto stride = static_cast<size_t>(resolution);
  const int across = resolution / kBlockWidth;
  for (; y < end; y += kBlockHeight) {
    size_t at = kTriangles * static_cast<size_t>(y / kBlockHeight * across + x / kBlockWidth);
    float* texels = map + static_cast<size_t>(y) * stride + static_cast<size_t>(x);
    for (const float* const last = texels + width; texels < last;
         texels += kBlockWidth, at += kTriangles) {
      const Floats dx = loadAt(d.x, at), dy = loadAt(d.y, at), dz = loadAt(d.z, at);
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

// Rows that are rendered together; what they read and write fits into the L1 cache.
struct ShadowRaster::Band {
  const ShadowMapGrid& grid;
  int firstRow, lastRow;
  int firstTile, lastTile;     // rows of tiles that the band overlaps
  std::vector<uint8_t> marks;  // by block: it is traced by rays
  // By tile: a lower bound of the values stored in its texels in these rows.
  alignas(32) float least[kBand / kLeastTile][kRow] = {};

  Band(const ShadowMapGrid& g, int first, int last)
      : grid(g),
        firstRow(first),
        lastRow(last),
        firstTile(first / g.tile),
        lastTile((last + g.tile - 1) / g.tile) {}
  // The part of a row of tiles inside the band.
  int top(int row) const { return std::max(firstRow, row * grid.tile); }
  int bottom(int row) const { return std::min(lastRow, (row + 1) * grid.tile); }
};

void ShadowRaster::setScene(const RenderScene& scene, const std::vector<uint32_t>* moved) {
  std::vector<uint32_t> simple, complex;
  size_t triangles = 0;
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    const RenderObject& o = scene.objects[i];
    const Material& material = scene.materials[static_cast<size_t>(o.material)];
    if (material.isClear()) continue;
    const bool isSimple =
        o.triangleCount() <= kMostOfObject && material.alphaMode != AlphaMode::mask;
    (isSimple ? simple : complex).push_back(i);
    triangles += isSimple ? o.triangleCount() : 0;
  }
  isUseful_ = triangles <= kMostTriangles && complex.size() <= kMostComplex;
  if (!isUseful_) {
    complex_.clear();
    return;
  }
  std::vector<ShadowTriangles::Corners> corners;
  for (const uint32_t i : simple) {
    const RenderObject& o = scene.objects[i];
    const uint32_t* const index = &scene.indices[o.firstIndex];
    for (uint32_t k = 0; k < o.indexCount; k += 3)
      corners.push_back({scene.positions[index[k]], scene.positions[index[k + 1]],
                         scene.positions[index[k + 2]]});
  }
  triangles_.set(std::move(corners));
  std::vector<Complex> before;
  std::swap(before, complex_);
  for (const uint32_t i : complex) {
    const RenderObject& o = scene.objects[i];
    const auto known = std::ranges::lower_bound(before, i, {}, &Complex::object);
    const bool isKnown = moved != nullptr && known != before.end() && known->object == i &&
                         std::ranges::find(*moved, i) == moved->end();
    complex_.push_back({i,
                        {o.bounds.centre(), o.bounds.radius()},
                        isKnown ? std::move(known->parts) : partsOfMesh(scene, o)});
  }
}

ShadowMapGrid::ShadowMapGrid(int texels) : resolution(texels), tile(kLeastTile) {
  while (resolution > tile * kMostTiles) tile *= 2;
  // Tile corners lie on the creases of the octahedron, so directions are linear on each side of a
  // tile's diagonal.
  if (resolution % tile != 0) tile = 0;
  if (tile == 0) return;
  tiles = resolution / tile;
  hemisphere = texelDirections(resolution, tile, false);
  parallel = texelDirections(resolution, tile, true);
}

// Marks the blocks that may see traced objects. Returns whether rasterising the others pays off.
bool ShadowRaster::markForRays(const LightSpace& light, Band& band) const {
  using Where = SphereInMap::Where;
  const TexelDirections& d = band.grid.directions(light.isParallel);
  const auto across = static_cast<size_t>(band.grid.resolution / kBlockWidth);
  const size_t first = static_cast<size_t>(band.firstRow / kBlockHeight) * across,
               count = static_cast<size_t>((band.lastRow - band.firstRow) / kBlockHeight) * across;
  std::vector<uint8_t>& marks = band.marks;
  marks.assign(count, 0);
  struct Blocks {
    size_t first;
    uint32_t see;  // one bit for each
  };
  std::vector<Blocks> near;
  for (const Complex& object : complex_) {
    const SphereInMap whole(light, d, object.whole);
    if (whole.where() == Where::nowhere) continue;
    if (whole.where() == Where::anywhere) return false;
    near.clear();
    for (size_t i = 0; i < count; i += kTriangles)
      if (const uint32_t see = whole.blocks(first + i); see != 0) near.push_back({i, see});
    for (const Sphere& sphere : object.parts) {
      const SphereInMap part(light, d, sphere);
      if (near.empty() || part.where() == Where::nowhere) continue;
      for (const Blocks& blocks : near) {
        uint32_t see = blocks.see;
        if (part.where() == Where::somewhere) see &= part.blocks(first + blocks.first);
        for (; see != 0; see &= see - 1)
          marks[blocks.first + static_cast<size_t>(std::countr_zero(see))] = 1;
      }
    }
  }
  const auto marked = static_cast<float>(std::count(marks.begin(), marks.end(), 1));
  return marked <= kMostOfBlocks * static_cast<float>(count);
}

std::vector<uint8_t> ShadowRaster::blocksThatSee(const ShadowMapGrid& grid, const shared::Vpl& vpl,
                                                 std::span<const Sphere> spheres) {
  if (grid.tile == 0) return {};
  const LightSpace light(vpl);
  const auto side = static_cast<size_t>(grid.resolution);
  std::vector<uint8_t> see(side / kBlockWidth * side / kBlockHeight, 0);
  for (const Sphere& s : spheres) {
    const SphereInMap sphere(light, grid.directions(light.isParallel), s);
    if (sphere.where() == SphereInMap::Where::anywhere) return {};
    if (sphere.where() == SphereInMap::Where::nowhere) continue;
    for (size_t i = 0; i < see.size(); i += kTriangles)
      for (uint32_t rest = sphere.blocks(i); rest != 0; rest &= rest - 1)
        see[i + static_cast<size_t>(std::countr_zero(rest))] = 1;
  }
  return see;
}

// Calls f(index into the band's marks) for the blocks of a tile inside the band.
template <typename F>
void ShadowRaster::forEachBlock(const Band& band, int ty, int tx, F&& f) {
  const int across = band.grid.resolution / kBlockWidth, tile = band.grid.tile;
  for (int y = band.top(ty); y < band.bottom(ty); y += kBlockHeight)
    for (int x = tx * tile; x < (tx + 1) * tile; x += kBlockWidth)
      f(static_cast<size_t>((y - band.firstRow) / kBlockHeight * across + x / kBlockWidth));
}

// Clears the tiles that have a wanted block (`wanted` empty: all tiles). In tiles where all blocks
// are traced, or none is wanted, nothing is drawn.
void ShadowRaster::prepareTiles(Band& band, std::span<const uint8_t> wanted, std::span<float> map) {
  const auto [resolution, tile] = std::pair(band.grid.resolution, band.grid.tile);
  for (int ty = band.firstTile; ty < band.lastTile; ++ty) {
    for (int tx = 0; tx < band.grid.tiles; ++tx) {
      bool isWanted = wanted.empty(), isLeft = true;
      forEachBlock(band, ty, tx, [&](size_t block) {
        isWanted = isWanted || wanted[block] != 0;
        isLeft = isLeft && band.marks[block] != 0;
      });
      if (!isWanted || isLeft)
        band.least[ty - band.firstTile][tx] = std::numeric_limits<float>::infinity();
      if (!isWanted) {
        forEachBlock(band, ty, tx, [&](size_t block) { band.marks[block] = 0; });
        continue;
      }
      for (int y = band.top(ty); y < band.bottom(ty); ++y)
        std::fill_n(map.begin() + y * resolution + tx * tile, tile, 0.0f);
    }
  }
}

void ShadowRaster::draw(const ShadowTriangles::Batch& batch, size_t lane, const LightSpace& light,
                        Band& band, std::span<float> map) {
  const TexelDirections& d = band.grid.directions(light.isParallel);
  const int tile = band.grid.tile, tiles = band.grid.tiles;
  const Triangle t(batch, lane);
  const auto slack = [&](size_t function) { return broadcast(batch.functions[function][3][lane]); };
  const Floats slackA = slack(0), slackB = slack(1), slackC = slack(2);
  // With an odd number of tiles, the middle tile contains the tip of the octahedron: values inside
  // it can exceed those at its corners.
  const Floats slackStored = tiles % 2 == 0 ? slack(ShadowTriangles::Batch::kPlane)
                                            : broadcast(std::numeric_limits<float>::infinity());
  const Floats zero = hn::Zero(kTag), most = broadcast(light.most);
  for (int first = 0; first < tiles; first += static_cast<int>(kTriangles)) {
    const uint32_t lanes = (1u << std::min(tiles - first, static_cast<int>(kTriangles))) - 1;
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
        least[tx] = draw(t, d, most, (first + tx) * tile, tile, band.top(ty), band.bottom(ty),
                         band.grid.resolution, map.data());
      }
    }
  }
}

uint64_t ShadowRaster::render(const RayCaster& rays, const ShadowMapGrid& grid,
                              const shared::Vpl& vpl, int firstRow, int lastRow,
                              std::span<float> map, std::span<const uint8_t> wanted,
                              std::span<uint8_t> isTraced) const {
  const int resolution = grid.resolution;
  if (grid.tile == 0) return traceShadowMap(rays, vpl, resolution, firstRow, lastRow, map);
  const LightSpace light(vpl);
  const auto across = static_cast<size_t>(resolution / kBlockWidth);
  std::vector<ShadowTriangles::Batch> batches;
  uint64_t cast = 0;
  for (int row = firstRow; row < lastRow; row += kBand) {
    Band band(grid, row, std::min(row + kBand, lastRow));
    std::span<const uint8_t> part;  // the blocks of this band; empty: all
    if (!wanted.empty()) {
      const int rows = band.lastRow - row;
      part = wanted.subspan(static_cast<size_t>(row / kBlockHeight) * across,
                            static_cast<size_t>(rows / kBlockHeight) * across);
      // No mover is visible in this band, so the choice between drawing and tracing is also
      // unchanged.
      if (std::ranges::count(part, 0) == std::ssize(part)) continue;
    }
    const bool isDrawn = isUseful_ && markForRays(light, band);
    uint8_t& wasTraced = isTraced[static_cast<size_t>(row / kBand)];
    if ((wasTraced != 0) == isDrawn) part = {};
    wasTraced = isDrawn ? 0 : 1;
    if (!isDrawn) {
      cast += traceShadowMap(rays, vpl, resolution, row, band.lastRow, map, part);
      continue;
    }
    if (batches.empty()) {
      batches.resize(triangles_.batches());
      triangles_.see(light, batches);
    }
    prepareTiles(band, part, map);
    for (const ShadowTriangles::Batch& batch : batches)
      for (uint32_t rest = batch.lanes; rest != 0; rest &= rest - 1)
        draw(batch, static_cast<size_t>(std::countr_zero(rest)), light, band, map);
    cast += traceShadowMap(rays, vpl, resolution, row, band.lastRow, map, band.marks);
  }
  return cast;
}

}  // namespace lamplighter::cpu
