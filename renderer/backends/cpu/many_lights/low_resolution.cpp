#include "renderer/backends/cpu/many_lights/low_resolution.h"

#include <algorithm>
#include <atomic>
#include <bit>

#include <tbb/parallel_for.h>

#include "renderer/backends/cpu/many_lights/carried_light.h"
#include "renderer/backends/cpu/many_lights/packet_limit.h"
#include "renderer/backends/cpu/many_lights/picture_light.h"
#include "renderer/base/simd.h"
#include "shaders/shared/low_resolution.h"

namespace lamplighter::cpu {
namespace {

using Tag = FloatTag;
using Floats = Floats8;

constexpr int kTilesPerTask = 16;

// The packets of a tile that cover a cell of `block` pixels in column cx and row cy of cells.
uint32_t packetsOfCell(int block, int cx, int cy) {
  const int x0 = cx * block / kPacketWidth, x1 = (cx * block + block - 1) / kPacketWidth;
  const int y0 = cy * block / kPacketHeight, y1 = (cy * block + block - 1) / kPacketHeight;
  uint32_t packets = 0;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) packets |= uint32_t{1} << (y * kPacketsPerRow + x);
  return packets;
}

// The first corner of a cell broadcast to all lanes: isOnSurface for eight points at a time.
class SurfaceTest {
 public:
  SurfaceTest(const GBuffer& g, size_t corner)
      : gbuffer_(g),
        x_(hn::Set(kTag, g.px[corner])),
        y_(hn::Set(kTag, g.py[corner])),
        z_(hn::Set(kTag, g.pz[corner])),
        nx_(hn::Set(kTag, g.gx[corner])),
        ny_(hn::Set(kTag, g.gy[corner])),
        nz_(hn::Set(kTag, g.gz[corner])),
        sx_(hn::Set(kTag, g.sx[corner])),
        sy_(hn::Set(kTag, g.sy[corner])),
        sz_(hn::Set(kTag, g.sz[corner])) {}

  // Whether these lanes of the packet at `first` lie on its surface. Misses have zero normals, so
  // the test fails for them.
  bool holds(size_t first, uint8_t lanes) const {
    const GBuffer& g = gbuffer_;
    const auto at = [&](const std::vector<float>& v) { return hn::LoadU(kTag, &v[first]); };
    const Floats dx = hn::Sub(at(g.px), x_), dy = hn::Sub(at(g.py), y_), dz = hn::Sub(at(g.pz), z_);
    const Floats off = dot(nx_, ny_, nz_, dx, dy, dz);
    const Floats distance2 = dot(dx, dy, dz, dx, dy, dz);
    const auto isInPlane =
        hn::Le(hn::Mul(off, off),
               hn::Mul(hn::Set(kTag, shared::kMostOffPlane * shared::kMostOffPlane), distance2));
    const auto isAlike = hn::Ge(dot(sx_, sy_, sz_, at(g.sx), at(g.sy), at(g.sz)),
                                hn::Set(kTag, shared::kLeastNormalCosine));
    uint8_t held[8];
    hn::StoreMaskBits(kTag, hn::And(isInPlane, isAlike), held);
    return (~held[0] & lanes) == 0;
  }

 private:
  static Floats dot(Floats ax, Floats ay, Floats az, Floats bx, Floats by, Floats bz) {
    return hn::MulAdd(ax, bx, hn::MulAdd(ay, by, hn::Mul(az, bz)));
  }

  const GBuffer& gbuffer_;
  Floats x_, y_, z_, nx_, ny_, nz_, sx_, sy_, sz_;
};

// Whether the packets with the pixels from (x0, y0) to (x1, y1), inclusive, show one flat triangle.
bool isOneTriangle(const GBuffer& g, int x0, int y0, int x1, int y1) {
  const auto at = [&](int x, int y) { return g.packetTriangle[g.index(x, y) / kLanes]; };
  const uint64_t first = at(x0, y0);
  if (first == GBuffer::kMany) return false;
  for (int y = y0 / kPacketHeight * kPacketHeight; y <= y1; y += kPacketHeight)
    for (int x = x0 / kPacketWidth * kPacketWidth; x <= x1; x += kPacketWidth)
      if (at(x, y) != first) return false;
  return true;
}

// Whether all pixels from (x0, y0) to (x1, y1), inclusive, lie on the surface of the first one.
bool isOnOneSurface(const GBuffer& g, int x0, int y0, int x1, int y1) {
  const SurfaceTest surface(g, g.index(x0, y0));
  for (int y = y0; y <= y1; y = y / kPacketHeight * kPacketHeight + kPacketHeight) {
    for (int x = x0; x <= x1; x = x / kPacketWidth * kPacketWidth + kPacketWidth) {
      const int left = x % kPacketWidth, top = y % kPacketHeight;
      const int right = std::min(kPacketWidth - 1, x1 - (x - left));
      const int bottom = std::min(kPacketHeight - 1, y1 - (y - top));
      const auto row = static_cast<uint8_t>(((2u << right) - 1) & ~((1u << left) - 1));
      uint8_t lanes = 0;
      if (top == 0) lanes |= row;
      if (bottom == 1) lanes |= static_cast<uint8_t>(row << kPacketWidth);
      const size_t first = g.index(x - left, y - top);
      if (!surface.holds(first, lanes)) return false;
    }
  }
  return true;
}

// A pair of corners of a cell; corners are numbered row by row.
struct Pair {
  int a, b;
};
constexpr Pair kPairs[] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
constexpr uint8_t kAllPairs = (1u << std::size(kPairs)) - 1;

// Which pairs of these points lie on one surface, one bit each.
uint8_t pairsOnOneSurface(const GBuffer& g, const size_t (&corners)[4]) {
  const auto position = [&](size_t i) { return vec3(g.px[i], g.py[i], g.pz[i]); };
  const auto shading = [&](size_t i) { return vec3(g.sx[i], g.sy[i], g.sz[i]); };
  uint8_t pairs = 0;
  for (size_t k = 0; k < std::size(kPairs); ++k) {
    const size_t a = corners[kPairs[k].a], b = corners[kPairs[k].b];
    const vec3 normal(g.gx[a], g.gy[a], g.gz[a]);
    if (shared::isOnSurface(position(a), normal, shading(a), position(b), shading(b)))
      pairs |= static_cast<uint8_t>(1u << k);
  }
  return pairs;
}

// Whether light linking excludes the same lights for all these pixels.
bool isLitAlike(const GBuffer& g, std::span<const uint32_t> leftOutBy, int x0, int y0, int x1,
                int y1) {
  const uint32_t first = leftOutBy[g.object[g.index(x0, y0)]];
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      if (leftOutBy[g.object[g.index(x, y)]] != first) return false;
  return true;
}

}  // namespace

void LowResolution::takeSamples(const GBuffer& g) {
  tbb::parallel_for(0, samples_.tiles(), [&](int tile) {
    const int i0 = tile % samples_.tilesX * kTileSize, j0 = tile / samples_.tilesX * kTileSize;
    const int i1 = std::min(i0 + kTileSize, samples_.width),
              j1 = std::min(j0 + kTileSize, samples_.height);
    const auto pixelOf = [&](int i, int j) {
      return g.index(std::min(block_ * i, width_ - 1), std::min(block_ * j, height_ - 1));
    };
    // Revisions only grow, so their sum tells whether one of them changed. The last sample of a row
    // or column may lie in an extra tile, outside the picture's tiles.
    const auto firstTile = [&](int sample, int tiles) {
      return std::min(sample * block_ / kTileSize, tiles - 1);
    };
    uint64_t revision = 0;
    for (int y = firstTile(j0, g.tilesY); y < g.tilesY && y * kTileSize < j1 * block_; ++y)
      for (int x = firstTile(i0, g.tilesX); x < g.tilesX && x * kTileSize < i1 * block_; ++x)
        revision += g.revision[static_cast<size_t>(y * g.tilesX + x)];
    const auto t = static_cast<size_t>(tile);
    if (sampleRevisions_[t] == revision) return;
    sampleRevisions_[t] = revision;
    ++samples_.revision[t];
    for (int j = j0; j < j1; ++j) {
      for (int i = i0; i < i1; ++i) {
        const size_t from = pixelOf(i, j), to = samples_.index(i, j);
        samples_.px[to] = g.px[from];
        samples_.py[to] = g.py[from];
        samples_.pz[to] = g.pz[from];
        // On one flat triangle everything except the position is equal. Read it from the tile's
        // first pixel, which is probably cached: the pixels of samples are far apart in memory.
        const size_t tileOf = from / kTilePixels;
        const size_t like = g.onlyTriangle[tileOf] == GBuffer::kMany ? from : tileOf * kTilePixels;
        samples_.sx[to] = g.sx[like];
        samples_.sy[to] = g.sy[like];
        samples_.sz[to] = g.sz[like];
        samples_.gx[to] = g.gx[like];
        samples_.gy[to] = g.gy[like];
        samples_.gz[to] = g.gz[like];
        samples_.ar[to] = g.ar[like];
        samples_.ag[to] = g.ag[like];
        samples_.ab[to] = g.ab[like];
        samples_.hit[to] = g.hit[like];
        samples_.object[to] = g.object[like];
        samples_.triangle[to] = g.triangle[like];
      }
    }
    for (int packet = 0; packet < kPacketsPerTile; ++packet) samples_.findFlat(tile, packet);
  });
}

void LowResolution::findPlanes(const GBuffer& g, int tile, std::span<const uint32_t> leftOutBy) {
  const int x0 = tile % tilesX_ * kTileSize, y0 = tile / tilesX_ * kTileSize;
  // Usually all is one triangle.
  uint64_t only = g.onlyTriangle[static_cast<size_t>(tile)];
  for (int y = tile / tilesX_; y < std::min(tile / tilesX_ + 2, tilesY_); ++y)
    for (int x = tile % tilesX_; x < std::min(tile % tilesX_ + 2, tilesX_); ++x)
      if (g.onlyTriangle[static_cast<size_t>(y * tilesX_ + x)] != only) only = GBuffer::kMany;
  const bool isOnly = only != GBuffer::kMany;
  for (int y = y0; y < std::min(y0 + kTileSize, height_); y += block_) {
    for (int x = x0; x < std::min(x0 + kTileSize, width_); x += block_) {
      const int right = std::min(x + block_, width_ - 1),
                bottom = std::min(y + block_, height_ - 1);
      const bool isOne = isOnly || isOneTriangle(g, x, y, right, bottom) ||
                         (isOnOneSurface(g, x, y, right, bottom) &&
                          (leftOutBy.empty() || isLitAlike(g, leftOutBy, x, y, right, bottom)));
      const size_t cell = cellAt(x / block_, y / block_);
      planes_[cell] = isOne ? 0 : kNoPlane;
      pairs_[cell] = isOne ? kAllPairs
                           : pairsOnOneSurface(g, {g.index(x, y), g.index(right, y),
                                                   g.index(x, bottom), g.index(right, bottom)});
    }
  }
}

void LowResolution::update(const GBuffer& g, int block, std::span<const uint32_t> leftOutBy) {
  const auto tiles = static_cast<size_t>(g.tiles());
  if (g.width != width_ || g.height != height_ || block != block_) {
    width_ = g.width;
    height_ = g.height;
    tilesX_ = g.tilesX;
    tilesY_ = g.tilesY;
    block_ = block;
    perBlock_ = 1.0f / static_cast<float>(block);
    samples_.resize(shared::lowResolutionSamples(width_, block),
                    shared::lowResolutionSamples(height_, block));
    sampleRevisions_.assign(static_cast<size_t>(samples_.tiles()), 0);
    planeRevisions_.assign(tiles, 0);
    cellsX_ = (width_ + block - 1) / block;
    cellsY_ = (height_ + block - 1) / block;
    const size_t cells = static_cast<size_t>(cellsX_ + 2) * static_cast<size_t>(cellsY_ + 2);
    for (auto* v : {&planes_, &pairs_, &cells_}) v->assign(cells, 0);
    for (auto* v : {&red_, &green_, &blue_})
      v->assign(rowLength() * static_cast<size_t>(samples_.height + 1) + kLanes, 0.0f);
    isHard_.assign(red_.size(), 0);
    edges_.assign(tiles, 0);
  }
  picture_ = &g;
  takeSamples(g);
  tbb::parallel_for(0, (g.tiles() + kTilesPerTask - 1) / kTilesPerTask, [&](int task) {
    for (int tile = task * kTilesPerTask; tile < std::min((task + 1) * kTilesPerTask, g.tiles());
         ++tile) {
      // Cells extend to the first pixels of the next tiles.
      const int x = tile % tilesX_, y = tile / tilesX_;
      uint64_t revision = 0;
      for (int ny = y; ny < std::min(y + 2, tilesY_); ++ny)
        for (int nx = x; nx < std::min(x + 2, tilesX_); ++nx)
          revision += g.revision[static_cast<size_t>(ny * tilesX_ + nx)];
      const auto t = static_cast<size_t>(tile);
      if (planeRevisions_[t] == revision) continue;
      planeRevisions_[t] = revision;
      findPlanes(g, tile, leftOutBy);
    }
  });
}

void LowResolution::takeLight(const PictureLight& light, std::span<const uint8_t> isHard, int row) {
  const int from = std::min(row, samples_.height - 1);
  const size_t to = static_cast<size_t>(row) * rowLength();
  for (int i = 0; i <= samples_.width; i += kPacketWidth) {
    const size_t first = samples_.index(std::min(i, samples_.width - 1), from);
    const size_t packet = first / kLanes;
    PacketIrradiance room;
    const auto e = light.at(static_cast<int>(packet / kPacketsPerTile),
                            static_cast<int>(packet % kPacketsPerTile), room);
    for (int k = i; k < std::min(i + kPacketWidth, samples_.width + 1); ++k) {
      const size_t sample = samples_.index(std::min(k, samples_.width - 1), from);
      const size_t lane = sample % kLanes, at = to + static_cast<size_t>(k);
      isHard_[at] = isHard[sample];
      red_[at] = e.r[lane];
      green_[at] = e.g[lane];
      blue_[at] = e.b[lane];
    }
  }
}

// Whether the light of two corners on one surface differs much, in the cell whose first sample is
// at `at`.
bool LowResolution::isCutByShadow(uint8_t pairs, size_t at) const {
  const size_t corners[] = {at, at + 1, at + rowLength(), at + rowLength() + 1};
  const auto light = [&](size_t i) { return vec3(red_[i], green_[i], blue_[i]); };
  for (size_t k = 0; k < std::size(kPairs); ++k) {
    if ((pairs >> k & 1) == 0) continue;
    const vec3 a = light(corners[kPairs[k].a]), b = light(corners[kPairs[k].b]);
    if (!shared::isSmooth(a, b, a, b, shared::kMostContrastAbout)) return true;
  }
  return false;
}

// shared::isSmooth for eight cells at a time.
void LowResolution::findContrast(int row, bool hasHardLights) {
  const Floats most = hn::Set(kTag, shared::kMostContrast);
  const Floats mostAbout = hn::Set(kTag, shared::kMostContrastAbout);
  for (int i = 0; i < cellsX_; i += kLanes) {
    const size_t at = static_cast<size_t>(row) * rowLength() + static_cast<size_t>(i);
    hn::Mask<Tag> differs = hn::MaskFromVec(hn::Zero(kTag)), differsMuch = differs;
    for (const auto* v : {&red_, &green_, &blue_}) {
      // Lanes past the end of the row are read but not used.
      const float* above = v->data() + at;
      const float* below = above + rowLength();
      const Floats a = hn::LoadU(kTag, above), b = hn::LoadU(kTag, above + 1);
      const Floats c = hn::LoadU(kTag, below), d = hn::LoadU(kTag, below + 1);
      const Floats high = hn::Max(hn::Max(a, b), hn::Max(c, d));
      const Floats spread = hn::Sub(high, hn::Min(hn::Min(a, b), hn::Min(c, d)));
      differs = hn::Or(differs, hn::Gt(spread, hn::Mul(most, high)));
      differsMuch = hn::Or(differsMuch, hn::Gt(spread, hn::Mul(mostAbout, high)));
    }
    uint8_t bits[8], muchBits[8];
    hn::StoreMaskBits(kTag, differs, bits);
    hn::StoreMaskBits(kTag, differsMuch, muchBits);
    for (int k = 0; k < std::min(kLanes, cellsX_ - i); ++k) {
      const size_t cell = cellAt(i + k, row);
      uint8_t is = planes_[cell];
      const uint8_t* hard = isHard_.data() + at + static_cast<size_t>(k);
      const bool isHard = (hard[0] | hard[1] | hard[rowLength()] | hard[rowLength() + 1]) != 0;
      if ((bits[0] >> k & 1) != 0 || isHard) is |= kContrast;
      if ((muchBits[0] >> k & 1) != 0 && (hasHardLights || pairs_[cell] == kAllPairs ||
                                          isCutByShadow(pairs_[cell], at + static_cast<size_t>(k))))
        is |= kMuchContrast;
      cells_[cell] = is;
    }
  }
}

uint32_t LowResolution::edgesOf(int tile) const {
  const int side = kTileSize / block_;
  const int i0 = tile % tilesX_ * side, j0 = tile / tilesX_ * side;
  uint32_t edges = 0;
  for (int j = j0; j < std::min(j0 + side, cellsY_); ++j) {
    for (int i = i0; i < std::min(i0 + side, cellsX_); ++i) {
      const uint8_t* cell = &cells_[cellAt(i, j)];
      const auto about = [&](ptrdiff_t row) {
        const uint8_t* c = cell + row * (cellsX_ + 2);
        return c[-1] | c[0] | c[1];
      };
      if (*cell != 0 || ((about(-1) | about(0) | about(1)) & kMuchContrast) != 0)
        edges |= packetsOfCell(block_, i - i0, j - j0);
    }
  }
  return edges;
}

void LowResolution::findEdges(const GBuffer& picture, const PictureLight& light) {
  const IrradianceAccumulator::HardShadows hard = light.sums.findHardShadows();
  tbb::parallel_for(0, samples_.height + 1, [&](int row) { takeLight(light, hard.at, row); });
  tbb::parallel_for(0, cellsY_, [&](int row) { findContrast(row, hard.hasLights); });
  std::atomic<uint64_t> interpolated = 0;
  const int tiles = tilesX_ * tilesY_;
  tbb::parallel_for(0, (tiles + kTilesPerTask - 1) / kTilesPerTask, [&](int task) {
    uint64_t pixels = 0;
    for (int tile = task * kTilesPerTask; tile < std::min((task + 1) * kTilesPerTask, tiles);
         ++tile) {
      const uint32_t edges = edgesOf(tile);
      edges_[static_cast<size_t>(tile)] = edges;
      pixels += static_cast<uint64_t>(picture.pixelsOf(tile, ~edges));
    }
    interpolated += pixels;
  });
  interpolated_ = interpolated;
  summed_ = edges_;
  isLong_ = false;
}

void LowResolution::limitEdges(const GBuffer& picture, const IrradianceAccumulator& sums,
                               std::span<const LightRecord> lights, uint64_t mostLightPixels,
                               bool isMoving) {
  PacketLimit limit(picture, sums, lights, mostLightPixels);
  uint64_t whole = 0;
  for (const uint32_t edges : edges_) whole += limit.costOf(edges);
  isLong_ = whole > mostLightPixels;
  // Where not all can be summed, and most is carried over anyway, three eighths are enough.
  if (isMoving && isLong_ && carried_ != nullptr) limit.lowerTo(mostLightPixels / 8 * 3);
  const size_t tiles = edges_.size();
  for (size_t t = 0; t < tiles; ++t) summed_[t] = limit.goOn(t, edges_[t]);
  const size_t first = carried_ != nullptr ? nextTile_ : 0;
  const auto begin = [&](const auto& among) {
    for (size_t k = 0; k < tiles && !limit.isReached(); ++k) {
      const size_t t = (first + k) % tiles;
      summed_[t] |= limit.begin(t, edges_[t] & ~summed_[t] & among(t));
      nextTile_ = t;
    }
  };
  if (carried_ != nullptr) begin([&](size_t t) { return ~carried_->whole(t); });
  begin([](size_t) { return ~uint32_t{0}; });
}

}  // namespace lamplighter::cpu
