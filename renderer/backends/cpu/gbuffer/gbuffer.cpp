#include "renderer/backends/cpu/gbuffer/gbuffer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "renderer/backends/cpu/gbuffer/raster.h"

namespace lamplighter::cpu {

void GBuffer::resize(int w, int h) {
  width = w;
  height = h;
  tilesX = (w + kTileSize - 1) / kTileSize;
  tilesY = (h + kTileSize - 1) / kTileSize;
  const size_t n = static_cast<size_t>(tiles()) * kTilePixels;
  for (auto* v : {&px, &py, &pz, &sx, &sy, &sz, &gx, &gy, &gz, &ar, &ag, &ab, &er, &eg, &eb})
    v->assign(n, 0.0f);
  hit.assign(n, 0);
  object.assign(n, 0);
  triangle.assign(n, 0);
  isFlat.assign(n / kLanes, 0);
  packetTriangle.assign(n / kLanes, kMany);
  onlyTriangle.assign(static_cast<size_t>(tiles()), kMany);
  const uint64_t last = revision.empty() ? 0 : *std::max_element(revision.begin(), revision.end());
  revision.assign(static_cast<size_t>(tiles()), last);
}

int GBuffer::pixelsOf(int tile, uint32_t packets) const {
  const int w = std::min(kTileSize, width - tile % tilesX * kTileSize);
  const int h = std::min(kTileSize, height - tile / tilesX * kTileSize);
  if (packets == ~uint32_t{0}) return w * h;
  int pixels = 0;
  for (; packets != 0; packets &= packets - 1) {
    const int packet = std::countr_zero(packets);
    pixels += std::clamp(w - packet % kPacketsPerRow * kPacketWidth, 0, kPacketWidth) *
              std::clamp(h - packet / kPacketsPerRow * kPacketHeight, 0, kPacketHeight);
  }
  return pixels;
}

void GBuffer::setSurface(size_t i, const Surface& s, bool isFront) {
  const Seen seen(s, isFront);
  const auto set = [i](const vec3& v, auto& x, auto& y, auto& z) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  };
  set(seen.normal, sx, sy, sz);
  set(seen.geometricNormal, gx, gy, gz);
  set(s.albedo, ar, ag, ab);
  set(seen.emission, er, eg, eb);
}

bool GBuffer::shows(size_t i, const Surface& s, bool isFront) const {
  const Seen seen(s, isFront);
  return vec3(sx[i], sy[i], sz[i]) == seen.normal &&
         vec3(gx[i], gy[i], gz[i]) == seen.geometricNormal && albedo(i) == s.albedo &&
         emission(i) == seen.emission;
}

void GBuffer::findFlat(int tile, int packet) {
  const size_t first = static_cast<size_t>(tile) * kTilePixels + packet * kLanes;
  const auto same = [&](const std::vector<float>& a, const std::vector<float>& b) {
    return std::equal(&a[first], &a[first] + kLanes, &b[first]);
  };
  isFlat[first / kLanes] = same(sx, gx) && same(sy, gy) && same(sz, gz) ? 1 : 0;
}

size_t GBuffer::bytes() const { return px.size() * (15 * sizeof(float) + 10); }

namespace {

void store(GBuffer& out, size_t i, const RenderScene& scene, const Hit& hit,
           const vec3& direction) {
  out.hit[i] = hit ? 1 : 0;
  if (!hit) {
    for (auto* v : {&out.sx, &out.sy, &out.sz, &out.gx, &out.gy, &out.gz}) (*v)[i] = 0.0f;
    return;
  }
  out.object[i] = hit.object;
  out.triangle[i] = hit.triangle;
  const Surface s = surfaceAt(scene, hit.object, hit.triangle, hit.u, hit.v);
  const bool front = glm::dot(direction, s.geometricNormal) < 0.0f;
  out.px[i] = s.position.x;
  out.py[i] = s.position.y;
  out.pz[i] = s.position.z;
  out.setSurface(i, s, front);
}

void trace(const RenderScene& scene, const RayCaster& rays, const View& view, vec2 jitter, int tile,
           GBuffer& out) {
  const vec3 forward = view.forward();
  out.onlyTriangle[static_cast<size_t>(tile)] = GBuffer::kMany;
  std::fill_n(&out.packetTriangle[static_cast<size_t>(tile) * kPacketsPerTile], kPacketsPerTile,
              GBuffer::kMany);
  const int x0 = (tile % out.tilesX) * kTileSize, y0 = (tile / out.tilesX) * kTileSize;
  for (int packet = 0; packet < kPacketsPerTile; ++packet) {
    std::array<Ray, kLanes> ray;
    std::array<Hit, kLanes> hit;
    for (int lane = 0; lane < kLanes; ++lane) {
      const int x = x0 + (packet % kPacketsPerRow) * kPacketWidth + lane % kPacketWidth;
      const int y = y0 + (packet / kPacketsPerRow) * kPacketHeight + lane / kPacketWidth;
      Ray& r = ray[lane];
      r.origin = view.eye;
      r.direction = view.rayDirection(static_cast<float>(x) + 0.5f + jitter.x,
                                      static_cast<float>(y) + 0.5f + jitter.y);
      r.tNear = view.znear / glm::dot(r.direction, forward);  // the near plane, as for a rasteriser
      if (x >= view.width || y >= view.height) r.tFar = -1.0f;
    }
    rays.intersect8(ray, hit, Surfaces::seen);
    const size_t first = static_cast<size_t>(tile) * kTilePixels + packet * kLanes;
    for (int lane = 0; lane < kLanes; ++lane)
      store(out, first + lane, scene, hit[lane], ray[lane].direction);
    out.findFlat(tile, packet);
  }
}

// The tiles whose pixels may see the box; the end is exclusive in both directions.
struct TileRange {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

TileRange tilesThatMaySee(const View& view, const GBuffer& g, const Bounds& box) {
  if (box.empty()) return {};
  vec2 low(std::numeric_limits<float>::max()), high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const vec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                 corner & 4 ? box.max.z : box.min.z);
    const vec3 at = view.project(p);
    // the box extends behind the near plane
    if (at.z <= view.znear) return {0, 0, g.tilesX, g.tilesY};
    low = glm::min(low, vec2(at));
    high = glm::max(high, vec2(at));
  }
  // Two extra pixels for rounding.
  const auto tileOf = [](float pixel, int tiles) {
    return std::clamp(static_cast<int>(std::floor(std::clamp(pixel, -1e6f, 1e6f) / kTileSize)), 0,
                      tiles);
  };
  return {tileOf(low.x - 2.0f, g.tilesX), tileOf(low.y - 2.0f, g.tilesY),
          tileOf(high.x + 2.0f + kTileSize, g.tilesX), tileOf(high.y + 2.0f + kTileSize, g.tilesY)};
}

}  // namespace

namespace {

// Traces the tiles of `wanted` (by tile), or all tiles.
void traceTiles(const RenderScene& scene, const RayCaster& rays, const View& view, vec2 jitter,
                std::span<const uint8_t> wanted, GBuffer& out) {
  const auto forEachTile = [&](auto&& f) {
    tbb::parallel_for(0, out.tiles(), [&](int tile) {
      if (!wanted.empty() && wanted[static_cast<size_t>(tile)] == 0) return;
      f(tile);
      ++out.revision[static_cast<size_t>(tile)];
    });
  };
  if (scene.triangleCount() > Raster::kMostTriangles) {
    forEachTile([&](int tile) { trace(scene, rays, view, jitter, tile, out); });
    return;
  }
  const Raster raster(scene, view, jitter, out, wanted);
  forEachTile([&](int tile) { raster.trace(tile, out); });
}

}  // namespace

uint64_t renderGBuffer(const RenderScene& scene, const RayCaster& rays, const View& view,
                       vec2 jitter, GBuffer& out) {
  if (out.width != view.width || out.height != view.height) out.resize(view.width, view.height);
  traceTiles(scene, rays, view, jitter, {}, out);
  return static_cast<uint64_t>(view.width) * view.height;
}

uint64_t updateGBuffer(const RenderScene& scene, const RayCaster& rays, const View& view,
                       std::span<const Bounds> boxes, GBuffer& out) {
  std::vector<uint8_t> isStale(static_cast<size_t>(out.tiles()), 0);
  uint64_t traced = 0;
  for (const Bounds& box : boxes) {
    const TileRange range = tilesThatMaySee(view, out, box);
    for (int y = range.y0; y < range.y1; ++y)
      for (int x = range.x0; x < range.x1; ++x) {
        uint8_t& stale = isStale[static_cast<size_t>(y * out.tilesX + x)];
        if (stale == 0) traced += static_cast<uint64_t>(out.pixelsOf(y * out.tilesX + x));
        stale = 1;
      }
  }
  if (traced > 0) traceTiles(scene, rays, view, vec2(0.0f), isStale, out);
  return traced;
}

}  // namespace lamplighter::cpu
