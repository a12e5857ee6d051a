// The G-buffer of the cpu backend: structure of arrays in tiles, so that eight pixels load as
// vectors.
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

// Tiles of 16×16 pixels, each of 32 packets of 4×2 pixels. The points of a packet fall into few
// texels of a shadow map, its rays are coherent, and a tile with its sums fits into the L1 cache.
inline constexpr int kLanes = 8;
inline constexpr int kPacketWidth = 4, kPacketHeight = 2;
inline constexpr int kTileSize = 16;
inline constexpr int kPacketsPerRow = kTileSize / kPacketWidth;
inline constexpr int kPacketsPerTile = kTileSize * kTileSize / kLanes;
inline constexpr int kTilePixels = kTileSize * kTileSize;

struct GBuffer {
  int width = 0, height = 0;
  int tilesX = 0, tilesY = 0;
  // One entry per pixel, tile by tile; pixels outside the image are misses. At misses the normals
  // are zero, so no light reaches the lane.
  std::vector<float> px, py, pz;  // world position [m]
  std::vector<float> sx, sy, sz;  // shading normal, on the side that faces the eye
  std::vector<float> gx, gy, gz;  // geometric normal, on the same side
  std::vector<float> ar, ag, ab;  // albedo
  std::vector<float> er, eg, eb;  // emission towards the eye [W/(m² sr)]
  std::vector<uint8_t> hit;
  std::vector<uint32_t> object, triangle;  // valid where something was hit
  std::vector<uint8_t> isFlat;  // by packet: all its geometric and shading normals are equal
  // By packet and by tile: object << 32 | triangle if all its pixels show one flat triangle of one
  // colour; kMany otherwise or if this was not tested.
  static constexpr uint64_t kMany = ~uint64_t{0};
  std::vector<uint64_t> packetTriangle, onlyTriangle;
  std::vector<uint64_t> revision;  // by tile; increases each time the tile is traced

  // Makes all pixels misses and gives each tile a revision that was never used.
  void resize(int w, int h);
  int tiles() const { return tilesX * tilesY; }
  // Number of image pixels in a tile, or in the given packets of it (one bit each).
  int pixelsOf(int tile, uint32_t packets = ~uint32_t{0}) const;
  size_t index(int x, int y) const {
    const auto column = static_cast<size_t>(x), row = static_cast<size_t>(y);
    constexpr size_t kSide = kTileSize, kWide = kPacketWidth, kHigh = kPacketHeight;
    // The parts that the pixels of a row share, and those that the pixels of a column share.
    const size_t across =
        column / kSide * kTilePixels + column % kSide / kWide * kLanes + column % kWide;
    const size_t down = row / kSide * static_cast<size_t>(tilesX) * kTilePixels +
                        row % kSide / kHigh * kPacketsPerRow * kLanes + row % kHigh * kWide;
    return down + across;
  }
  vec3 albedo(size_t i) const { return {ar[i], ag[i], ab[i]}; }
  vec3 emission(size_t i) const { return {er[i], eg[i], eb[i]}; }

  // A surface, seen from its front or back.
  struct Seen {
    vec3 normal, geometricNormal, emission;
    Seen(const Surface& s, bool isFront)
        : normal((isFront ? 1.0f : -1.0f) * s.normal),
          geometricNormal((isFront ? 1.0f : -1.0f) * s.geometricNormal),
          emission(isFront || s.emitsBothSides ? s.emission : vec3(0.0f)) {}
  };
  // Writes the surface seen at pixel i, except its position.
  void setSurface(size_t i, const Surface& surface, bool isFront);
  // Whether pixel i already holds these values.
  bool shows(size_t i, const Surface& surface, bool isFront) const;
  // Sets isFlat of a packet after its pixels are written.
  void findFlat(int tile, int packet);
  size_t bytes() const;
};

// Traces one ray per pixel; `jitter` is in pixels from the pixel's middle. Returns the number of
// rays.
uint64_t renderGBuffer(const RenderScene& scene, const RayCaster& rays, const View& view,
                       vec2 jitter, GBuffer& out);
// The same for only those tiles that may show something inside one of the boxes; other tiles keep
// their contents. The view must be the one of the whole G-buffer, without jitter.
uint64_t updateGBuffer(const RenderScene& scene, const RayCaster& rays, const View& view,
                       std::span<const Bounds> boxes, GBuffer& out);

}  // namespace lamplighter::cpu
