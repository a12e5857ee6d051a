// x86-64-v3 has no AES instructions, which Highway wants of its AVX2 target unless told otherwise.
#define HWY_DISABLE_PCLMUL_AES 1

#include "renderer/backends/cpu/low_resolution.h"

#include <algorithm>
#include <atomic>

#include <hwy/highway.h>
#include <tbb/parallel_for.h>

#include "shaders/shared/low_resolution.h"

namespace lamplighter::cpu {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::FixedTag<float, kLanes>;
using Floats = hn::Vec<Tag>;
constexpr Tag kTag;

constexpr int kTilesPerTask = 16;

// Packets of a tile that cover a cell of `block` pixels in column cx and row cy of cells.
uint32_t packetsOfCell(int block, int cx, int cy) {
  const int x0 = cx * block / kPacketWidth, x1 = (cx * block + block - 1) / kPacketWidth;
  const int y0 = cy * block / kPacketHeight, y1 = (cy * block + block - 1) / kPacketHeight;
  uint32_t packets = 0;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) packets |= uint32_t{1} << (y * kPacketsPerRow + x);
  return packets;
}

// The first corner of a cell in every lane: isOnSurface for eight points at a time.
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

  // Whether those lanes of the packet that begins there lie on its surface. Where nothing is hit
  // the normals are zero, and the test fails.
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

// Whether all pixels from (x0, y0) to (x1, y1), both among them, lie on the surface at the first.
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

vec3 mix(const vec3& a, const vec3& b, float t) { return a + t * (b - a); }

}  // namespace

size_t LowResolution::sampleAt(int i, int j) const {
  return samples_.index(std::min(i, samples_.width - 1), std::min(j, samples_.height - 1));
}

void LowResolution::takeSamples(const GBuffer& g) {
  tbb::parallel_for(0, samples_.tiles(), [&](int tile) {
    const int i0 = tile % samples_.tilesX * kTileSize, j0 = tile / samples_.tilesX * kTileSize;
    const int i1 = std::min(i0 + kTileSize, samples_.width),
              j1 = std::min(j0 + kTileSize, samples_.height);
    const auto pixelOf = [&](int i, int j) {
      return g.index(std::min(block_ * i, width_ - 1), std::min(block_ * j, height_ - 1));
    };
    // Revisions only grow, so that their sum tells whether one of them did.
    uint64_t revision = 0;
    for (int y = j0 * block_ / kTileSize; y < g.tilesY && y * kTileSize < j1 * block_; ++y)
      for (int x = i0 * block_ / kTileSize; x < g.tilesX && x * kTileSize < i1 * block_; ++x)
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
        samples_.sx[to] = g.sx[from];
        samples_.sy[to] = g.sy[from];
        samples_.sz[to] = g.sz[from];
        samples_.gx[to] = g.gx[from];
        samples_.gy[to] = g.gy[from];
        samples_.gz[to] = g.gz[from];
        samples_.hit[to] = g.hit[from];
        samples_.object[to] = g.object[from];
        samples_.triangle[to] = g.triangle[from];
      }
    }
    for (int packet = 0; packet < kPacketsPerTile; ++packet) samples_.findFlat(tile, packet);
  });
}

// The cells of a tile that lie on one surface, a bit each.
uint64_t LowResolution::planeCells(const GBuffer& g, int tile) const {
  const int x0 = tile % tilesX_ * kTileSize, y0 = tile / tilesX_ * kTileSize;
  uint64_t cells = 0;
  for (int cy = 0; cy < kTileSize / block_; ++cy) {
    for (int cx = 0; cx < kTileSize / block_; ++cx) {
      const int x = x0 + cx * block_, y = y0 + cy * block_;
      if (x >= width_ || y >= height_) continue;
      const int right = std::min(x + block_, width_ - 1),
                bottom = std::min(y + block_, height_ - 1);
      if (isOnOneSurface(g, x, y, right, bottom)) cells |= uint64_t{1} << (cy * kMostCells + cx);
    }
  }
  return cells;
}

void LowResolution::update(const GBuffer& g, int block) {
  const auto tiles = static_cast<size_t>(g.tiles());
  if (g.width != width_ || g.height != height_ || block != block_) {
    width_ = g.width;
    height_ = g.height;
    tilesX_ = g.tilesX;
    tilesY_ = g.tilesY;
    block_ = block;
    samples_.resize(shared::lowResolutionSamples(width_, block),
                    shared::lowResolutionSamples(height_, block));
    sampleRevisions_.assign(static_cast<size_t>(samples_.tiles()), 0);
    planeRevisions_.assign(tiles, 0);
    planes_.assign(tiles, 0);
    edges_.assign(tiles, 0);
  }
  takeSamples(g);
  tbb::parallel_for(0, (g.tiles() + kTilesPerTask - 1) / kTilesPerTask, [&](int task) {
    for (int tile = task * kTilesPerTask; tile < std::min((task + 1) * kTilesPerTask, g.tiles());
         ++tile) {
      // Cells reach over to the first pixels of the next tiles.
      const int x = tile % tilesX_, y = tile / tilesX_;
      uint64_t revision = 0;
      for (int ny = y; ny < std::min(y + 2, tilesY_); ++ny)
        for (int nx = x; nx < std::min(x + 2, tilesX_); ++nx)
          revision += g.revision[static_cast<size_t>(ny * tilesX_ + nx)];
      const auto t = static_cast<size_t>(tile);
      if (planeRevisions_[t] == revision) continue;
      planeRevisions_[t] = revision;
      planes_[t] = planeCells(g, tile);
    }
  });
}

void LowResolution::findEdges(const GBuffer& picture, const LightSums& light) {
  std::atomic<uint64_t> interpolated = 0;
  const int tiles = tilesX_ * tilesY_;
  tbb::parallel_for(0, (tiles + kTilesPerTask - 1) / kTilesPerTask, [&](int task) {
    uint64_t pixels = 0;
    for (int tile = task * kTilesPerTask; tile < std::min((task + 1) * kTilesPerTask, tiles);
         ++tile) {
      const int x0 = tile % tilesX_ * kTileSize, y0 = tile / tilesX_ * kTileSize;
      const uint64_t planes = planes_[static_cast<size_t>(tile)];
      uint32_t edges = 0;
      for (int cy = 0; cy < kTileSize / block_ && y0 + cy * block_ < height_; ++cy) {
        for (int cx = 0; cx < kTileSize / block_ && x0 + cx * block_ < width_; ++cx) {
          const int i = x0 / block_ + cx, j = y0 / block_ + cy;
          const auto e = [&](int di, int dj) { return light.irradiance(sampleAt(i + di, j + dj)); };
          const bool isPlane = (planes >> (cy * kMostCells + cx) & 1) != 0;
          if (!isPlane || !shared::isSmooth(e(0, 0), e(1, 0), e(0, 1), e(1, 1)))
            edges |= packetsOfCell(block_, cx, cy);
        }
      }
      edges_[static_cast<size_t>(tile)] = edges;
      pixels += static_cast<uint64_t>(picture.pixelsOf(tile, ~edges));
    }
    interpolated += pixels;
  });
  interpolated_ = interpolated;
}

void LowResolution::interpolate(const LightSums& light, int tile, int packet,
                                Irradiance& out) const {
  const int x0 = tile % tilesX_ * kTileSize + packet % kPacketsPerRow * kPacketWidth;
  const int y0 = tile / tilesX_ * kTileSize + packet / kPacketsPerRow * kPacketHeight;
  for (int lane = 0; lane < kLanes; ++lane) {
    const int x = x0 + lane % kPacketWidth, y = y0 + lane / kPacketWidth;
    const int i = x / block_, j = y / block_;
    // The last cells of a row or column may be narrower.
    const auto along = [&](int at, int cell, int size) {
      const int low = cell * block_, high = std::min(low + block_, size - 1);
      return high > low ? static_cast<float>(at - low) / static_cast<float>(high - low) : 0.0f;
    };
    const float tx = along(x, i, width_), ty = along(y, j, height_);
    const auto e = [&](int di, int dj) { return light.irradiance(sampleAt(i + di, j + dj)); };
    const vec3 sum = mix(mix(e(0, 0), e(1, 0), tx), mix(e(0, 1), e(1, 1), tx), ty);
    out.r[lane] = sum.r;
    out.g[lane] = sum.g;
    out.b[lane] = sum.b;
  }
}

}  // namespace lamplighter::cpu
