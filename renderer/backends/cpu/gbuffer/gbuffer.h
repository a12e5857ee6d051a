// The cpu backend's G-buffer: structure of arrays in tiles, so that eight pixels load as vectors.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "renderer/base/math.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"
#include "renderer/scene/surface.h"

namespace lamplighter::cpu {

// Tiles of 16×16 pixels, each of 32 packets of 4×2 pixels: a packet's rays are coherent and its
// points fall into few texels of a shadow map, and a tile with its sums fits the first-level cache.
inline constexpr int kLanes = 8;
inline constexpr int kPacketWidth = 4, kPacketHeight = 2;
inline constexpr int kTileSize = 16;
inline constexpr int kPacketsPerRow = kTileSize / kPacketWidth;
inline constexpr int kPacketsPerTile = kTileSize * kTileSize / kLanes;
inline constexpr int kTilePixels = kTileSize * kTileSize;

struct GBuffer {
  int width = 0, height = 0;
  int tilesX = 0, tilesY = 0;
  // One entry a pixel of each tile, in the order of the tiles; those past the image's edge are
  // misses. Where nothing is hit the normals are zero, so that no light reaches the lane.
  std::vector<float> px, py, pz;  // world position [m]
  std::vector<float> sx, sy, sz;  // shading normal, on the side that the eye sees
  std::vector<float> gx, gy, gz;  // geometric normal, on that side
  std::vector<float> ar, ag, ab;  // albedo
  std::vector<float> er, eg, eb;  // emission towards the eye [W/(m² sr)]
  std::vector<uint8_t> hit;
  std::vector<uint32_t> object, triangle;  // where something was hit
  std::vector<uint8_t> isFlat;             // of each packet: both normals are the same
  // Of each packet and of each tile: all of its pixels are on one flat triangle of one colour,
  // object << 32 | triangle; else, or where it was not looked for, kMany.
  static constexpr uint64_t kMany = ~uint64_t{0};
  std::vector<uint64_t> packetTriangle, onlyTriangle;
  std::vector<uint64_t> revision;  // of each tile, more each time it is traced

  // Everything is a miss then, and no revision is one that was before.
  void resize(int w, int h);
  int tiles() const { return tilesX * tilesY; }
  // Of the image, that a tile holds, or these of its packets (a bit each).
  int pixelsOf(int tile, uint32_t packets = ~uint32_t{0}) const;
  size_t index(int x, int y) const {
    const auto column = static_cast<size_t>(x), row = static_cast<size_t>(y);
    constexpr size_t kSide = kTileSize, kWide = kPacketWidth, kHigh = kPacketHeight;
    // What a row's pixels share, and what a column's do.
    const size_t across =
        column / kSide * kTilePixels + column % kSide / kWide * kLanes + column % kWide;
    const size_t down = row / kSide * static_cast<size_t>(tilesX) * kTilePixels +
                        row % kSide / kHigh * kPacketsPerRow * kLanes + row % kHigh * kWide;
    return down + across;
  }
  vec3 albedo(size_t i) const { return {ar[i], ag[i], ab[i]}; }
  vec3 emission(size_t i) const { return {er[i], eg[i], eb[i]}; }

  // A surface, from its front or back.
  struct Seen {
    vec3 normal, geometricNormal, emission;
    Seen(const Surface& s, bool isFront)
        : normal((isFront ? 1.0f : -1.0f) * s.normal),
          geometricNormal((isFront ? 1.0f : -1.0f) * s.geometricNormal),
          emission(isFront || s.emitsBothSides ? s.emission : vec3(0.0f)) {}
  };
  // What is seen; all but where it is.
  void setSurface(size_t i, const Surface& surface, bool isFront);
  // Whether that is there already.
  bool shows(size_t i, const Surface& surface, bool isFront) const;
  // Sets isFlat of a packet that was written.
  void findFlat(int tile, int packet);
  size_t bytes() const;
};

// Traces one ray a pixel; `jitter` in pixels from the pixel's middle. Returns the number of rays.
uint64_t renderGBuffer(const RenderScene& scene, const RayCaster& rays, const View& view,
                       vec2 jitter, GBuffer& out);
// The same for those tiles alone that may show something in one of the boxes; the others stay as
// they are. The view must be that of the whole, and jitter none.
uint64_t updateGBuffer(const RenderScene& scene, const RayCaster& rays, const View& view,
                       std::span<const Bounds> boxes, GBuffer& out);

}  // namespace lamplighter::cpu
