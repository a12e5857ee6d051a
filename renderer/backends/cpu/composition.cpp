#include "renderer/backends/cpu/composition.h"

#include <algorithm>
#include <cstring>

#include <tbb/parallel_for.h>

#include "renderer/base/simd.h"

namespace lamplighter::cpu {

vec3 Background::at(int x, int y) const {
  if (sky.kind == SkyKind::constant) return sky.radiance;
  return sky.radianceFrom(view.rayDirection(static_cast<float>(x) + 0.5f + jitter.x,
                                            static_cast<float>(y) + 0.5f + jitter.y));
}

void compose(const GBuffer& g, const PacketLight& light, const Background* background, bool white,
             Image& out) {
  tbb::parallel_for(0, g.tiles(), [&](int tile) {
    const int tileX = tile % g.tilesX * kTileSize, tileY = tile / g.tilesX * kTileSize;
    const Floats8 inversePi = hn::Set(kTag, 1.0f / kPi);
    for (int packet = 0; packet < kPacketsPerTile; ++packet) {
      const int x = tileX + packet % kPacketsPerRow * kPacketWidth,
                y = tileY + packet / kPacketsPerRow * kPacketHeight;
      if (x >= g.width || y >= g.height) continue;
      const size_t first = static_cast<size_t>(tile) * kTilePixels + packet * kLanes;
      PacketIrradiance room;
      const PacketIrradianceView irradiance = light(tile, packet, room);
      const auto channel = [&](const float* e, const std::vector<float>& albedo,
                               const std::vector<float>& emission) {
        const Floats8 scaled = hn::Mul(hn::LoadU(kTag, e), inversePi);
        const Floats8 reflected = white ? scaled : hn::Mul(hn::LoadU(kTag, &albedo[first]), scaled);
        return background == nullptr ? reflected
                                     : hn::Add(hn::LoadU(kTag, &emission[first]), reflected);
      };
      float pixels[3 * kLanes];
      hn::StoreInterleaved3(channel(irradiance.r, g.ar, g.er), channel(irradiance.g, g.ag, g.eg),
                            channel(irradiance.b, g.ab, g.eb), kTag, pixels);
      for (int lane = 0; lane < kLanes; ++lane) {
        if (g.hit[first + static_cast<size_t>(lane)] != 0) continue;
        const vec3 sky = background == nullptr
                             ? vec3(0.0f)
                             : background->at(x + lane % kPacketWidth, y + lane / kPacketWidth);
        std::memcpy(&pixels[3 * lane], &sky, sizeof(vec3));
      }
      const int columns = std::min(kPacketWidth, g.width - x),
                rows = std::min(kPacketHeight, g.height - y);
      const auto copy = [&](int row, size_t bytes) {
        std::memcpy(static_cast<void*>(&out.at(x, y + row)), &pixels[3 * kPacketWidth * row],
                    bytes);
      };
      for (int row = 0; row < rows; ++row) {
        if (columns == kPacketWidth) {
          copy(row, kPacketWidth * sizeof(vec3));  // constant size, so that it is inlined
        } else {
          copy(row, static_cast<size_t>(columns) * sizeof(vec3));
        }
      }
    }
  });
}

void compose(const GBuffer& g, const Image& irradiance, const Background& background, bool white,
             Image& out) {
  const auto light = [&](int tile, int packet, PacketIrradiance& room) {
    const int left = tile % g.tilesX * kTileSize + packet % kPacketsPerRow * kPacketWidth;
    const int top = tile / g.tilesX * kTileSize + packet / kPacketsPerRow * kPacketHeight;
    for (int lane = 0; lane < kLanes; ++lane) {
      // Lanes outside the image repeat its last row and column.
      const vec3& e = irradiance.at(std::min(left + lane % kPacketWidth, g.width - 1),
                                    std::min(top + lane / kPacketWidth, g.height - 1));
      room.r[lane] = e.r;
      room.g[lane] = e.g;
      room.b[lane] = e.b;
    }
    return PacketIrradianceView{room.r, room.g, room.b};
  };
  compose(g, light, &background, white, out);
}

}  // namespace lamplighter::cpu
