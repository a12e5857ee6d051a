// The rasteriser's data of one tile, for raster.cpp and raster_tile.cpp only.
#pragma once

#include "renderer/backends/cpu/gbuffer/raster.h"
#include "renderer/base/simd.h"

namespace lamplighter::cpu {
namespace raster {

using Floats = Floats8;
static_assert(hn::MaxLanes(kTag) == kLanes);

// The position of each lane inside a packet.
HWY_ALIGN inline constexpr float kLaneX[kLanes] = {0, 1, 2, 3, 0, 1, 2, 3};
HWY_ALIGN inline constexpr float kLaneY[kLanes] = {0, 0, 0, 0, 1, 1, 1, 1};

// The positions of the pixels of a packet in their tile.
struct Pixels {
  Floats x, y;
  explicit Pixels(int packet) {
    const int column = packet % kPacketsPerRow, row = packet / kPacketsPerRow;
    x = hn::Add(hn::Load(kTag, kLaneX), broadcast(static_cast<float>(column * kPacketWidth)));
    y = hn::Add(hn::Load(kTag, kLaneY), broadcast(static_cast<float>(row * kPacketHeight)));
  }
};

}  // namespace raster

// A triangle in a tile. Its edge functions at pixel (x, y) of the tile are atFirst + x·alongX +
// y·alongY, ≥ 0 inside; their sum × inverseDet is 1/depth along the view direction.
struct Raster::Candidate {
  uint32_t object, triangle;
  int large;  // as in Entry
  bool isFront, isMasked, coversAll;
  int x0, y0, x1, y1;  // the pixels of the tile that it can cover
  float atFirst[3], alongX[3], alongY[3];
  float inverseDet;

  raster::Floats edge(int i, raster::Floats x, raster::Floats y) const {
    return hn::MulAdd(broadcast(alongY[i]), y,
                      hn::MulAdd(broadcast(alongX[i]), x, broadcast(atFirst[i])));
  }
  // Weights of the corners at the points where the rays meet it.
  void weights(const raster::Pixels& at, raster::Floats (&w)[3]) const {
    for (int i = 0; i < 3; ++i) w[i] = edge(i, at.x, at.y);
    const raster::Floats scale = hn::Div(broadcast(1.0f), hn::Add(hn::Add(w[0], w[1]), w[2]));
    for (raster::Floats& of : w) of = hn::Mul(of, scale);
  }
  uint64_t name() const { return uint64_t{object} << 32 | triangle; }
};

struct Raster::TileHits {
  HWY_ALIGN float inverseDistance[kTilePixels];
  HWY_ALIGN int32_t candidate[kTilePixels];  // −1: none
  float mostInverse;                         // 1/distance of the near plane
};

}  // namespace lamplighter::cpu
