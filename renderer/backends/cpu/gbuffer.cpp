#include "renderer/backends/cpu/gbuffer.h"

#include <array>

#include <tbb/parallel_for.h>

#include "renderer/scene/surface.h"

namespace lamplighter::cpu {

void GBuffer::resize(int w, int h) {
  width = w;
  height = h;
  tilesX = (w + kTileSize - 1) / kTileSize;
  tilesY = (h + kTileSize - 1) / kTileSize;
  const size_t n = static_cast<size_t>(tiles()) * kTilePixels;
  for (auto* v : {&px, &py, &pz, &sx, &sy, &sz, &gx, &gy, &gz}) v->assign(n, 0.0f);
  albedo.assign(n, vec3(0.0f));
  emission.assign(n, vec3(0.0f));
  hit.assign(n, 0);
  object.assign(n, 0);
  triangle.assign(n, 0);
}

size_t GBuffer::bytes() const { return px.size() * (9 * sizeof(float) + 2 * sizeof(vec3) + 9); }

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
  const float side = front ? 1.0f : -1.0f;
  out.px[i] = s.position.x;
  out.py[i] = s.position.y;
  out.pz[i] = s.position.z;
  out.sx[i] = side * s.normal.x;
  out.sy[i] = side * s.normal.y;
  out.sz[i] = side * s.normal.z;
  out.gx[i] = side * s.geometricNormal.x;
  out.gy[i] = side * s.geometricNormal.y;
  out.gz[i] = side * s.geometricNormal.z;
  out.albedo[i] = s.albedo;
  out.emission[i] = front || s.emitsBothSides ? s.emission : vec3(0.0f);
}

}  // namespace

uint64_t renderGBuffer(const RenderScene& scene, const RayCaster& rays, const View& view,
                       vec2 jitter, GBuffer& out) {
  if (out.width != view.width || out.height != view.height) out.resize(view.width, view.height);
  const vec3 forward = view.forward();
  tbb::parallel_for(0, out.tiles(), [&](int tile) {
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
        r.tNear = view.znear / glm::dot(r.direction, forward);  // the near plane, as a rasteriser's
        if (x >= view.width || y >= view.height) r.tFar = -1.0f;
      }
      rays.intersect8(ray, hit, Surfaces::seen);
      const size_t first = static_cast<size_t>(tile) * kTilePixels + packet * kLanes;
      for (int lane = 0; lane < kLanes; ++lane) {
        store(out, first + lane, scene, hit[lane], ray[lane].direction);
      }
    }
  });
  return static_cast<uint64_t>(view.width) * view.height;
}

}  // namespace lamplighter::cpu
