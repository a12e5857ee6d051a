#include "renderer/backends/cpu/many_lights/adaptive_antialiasing.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/base/simd.h"
#include "shaders/shared/low_resolution.h"

namespace lamplighter::cpu {
namespace {

using Floats = Floats8;

// Largest difference between neighbouring pixels, as a share of the brighter one; a larger one is a
// shadow border.
constexpr float kMostStep = 0.1f;

Floats dotOf(const Floats (&a)[3], const Floats (&b)[3]) {
  return hn::MulAdd(a[0], b[0], hn::MulAdd(a[1], b[1], hn::Mul(a[2], b[2])));
}

// Whether all pixels of the packet at `first` show the same surface in both pictures, or nothing
// (shared::isOnSurface).
bool isSameSurface(const GBuffer& a, const GBuffer& b, size_t first) {
  const auto load = [&](const std::vector<float>& v) { return hn::LoadU(kTag, &v[first]); };
  const Floats way[3] = {hn::Sub(load(b.px), load(a.px)), hn::Sub(load(b.py), load(a.py)),
                         hn::Sub(load(b.pz), load(a.pz))};
  const Floats ga[3] = {load(a.gx), load(a.gy), load(a.gz)},
               gb[3] = {load(b.gx), load(b.gy), load(b.gz)};
  const Floats sa[3] = {load(a.sx), load(a.sy), load(a.sz)},
               sb[3] = {load(b.sx), load(b.sy), load(b.sz)};
  const Floats off = dotOf(ga, way);
  const auto isInPlane = hn::Le(
      hn::Mul(off, off),
      hn::Mul(hn::Set(kTag, shared::kMostOffPlane * shared::kMostOffPlane), dotOf(way, way)));
  const auto isAlike = hn::Ge(dotOf(sa, sb), hn::Set(kTag, shared::kLeastNormalCosine));
  const hn::RebindToUnsigned<FloatTag> ids;
  const auto isOneObject =
      hn::Eq(hn::LoadU(ids, &a.object[first]), hn::LoadU(ids, &b.object[first]));
  const auto isHit = hn::And(hn::And(isInPlane, isAlike), hn::RebindMask(kTag, isOneObject));
  // Misses have zero normals.
  const auto isMiss = hn::Eq(hn::Add(dotOf(ga, ga), dotOf(gb, gb)), hn::Zero(kTag));
  return hn::AllTrue(kTag, hn::Or(isHit, isMiss));
}

}  // namespace

void AdaptiveAntialiasing::take(const GBuffer& g, const PictureLight& light) {
  isTaken_ = true;
  // Pixels in rows; indices outside are clamped to the last row and column.
  const auto width = static_cast<size_t>(g.width), height = static_cast<size_t>(g.height);
  std::vector<float> brightness(width * height);
  tbb::parallel_for(0, g.tiles(), [&](int tile) {
    const int x0 = tile % g.tilesX * kTileSize, y0 = tile / g.tilesX * kTileSize;
    for (int packet = 0; packet < kPacketsPerTile; ++packet) {
      const int x = x0 + packet % kPacketsPerRow * kPacketWidth,
                y = y0 + packet / kPacketsPerRow * kPacketHeight;
      if (x >= g.width || y >= g.height) continue;
      PacketIrradiance room;
      const PacketIrradianceView e = light.at(tile, packet, room);
      for (int lane = 0; lane < kLanes; ++lane) {
        const int px = x + lane % kPacketWidth, py = y + lane / kPacketWidth;
        if (px < g.width && py < g.height)
          brightness[static_cast<size_t>(py) * width + static_cast<size_t>(px)] =
              e.r[lane] + e.g[lane] + e.b[lane];
      }
    }
  });
  const auto isEven = [&](int x0, int y0) {
    const int left = std::max(x0 - 1, 0), top = std::max(y0 - 1, 0),
              right = std::min(x0 + kPacketWidth, g.width - 1),
              bottom = std::min(y0 + kPacketHeight, g.height - 1);
    const auto differ = [](float a, float b) {
      return std::abs(a - b) > kMostStep * std::max(a, b);
    };
    for (int y = top; y <= bottom; ++y) {
      const float* row = &brightness[static_cast<size_t>(y) * width];
      for (int x = left; x <= right; ++x) {
        if (x < right && differ(row[x], row[x + 1])) return false;
        if (y < bottom && differ(row[x], row[x + g.width])) return false;
      }
    }
    return true;
  };
  even_.assign(static_cast<size_t>(g.tiles()), 0);
  tbb::parallel_for(0, g.tiles(), [&](int tile) {
    const int x0 = tile % g.tilesX * kTileSize, y0 = tile / g.tilesX * kTileSize;
    uint32_t even = 0;
    for (int packet = 0; packet < kPacketsPerTile; ++packet) {
      const int x = x0 + packet % kPacketsPerRow * kPacketWidth,
                y = y0 + packet / kPacketsPerRow * kPacketHeight;
      if (x >= g.width || y >= g.height || light.isBetween(tile, packet) || isEven(x, y))
        even |= uint32_t{1} << packet;
    }
    even_[static_cast<size_t>(tile)] = even;
  });
}

std::span<const uint32_t> AdaptiveAntialiasing::findOwn(const GBuffer& middle,
                                                        const GBuffer& moved) {
  own_.resize(even_.size());
  tbb::parallel_for(0, middle.tiles(), [&](int tile) {
    const size_t first = static_cast<size_t>(tile) * kTilePixels;
    uint32_t own = ~even_[static_cast<size_t>(tile)];
    for (size_t packet = 0; packet < kPacketsPerTile; ++packet)
      if ((own >> packet & 1) == 0 && !isSameSurface(middle, moved, first + packet * kLanes))
        own |= uint32_t{1} << packet;
    own_[static_cast<size_t>(tile)] = own;
  });
  return own_;
}

}  // namespace lamplighter::cpu
