// Positions of the texels of a light map tile: a grid from corner to corner of its patch.
#pragma once

#include <array>

#include "renderer/light_maps/accumulate.h"
#include "renderer/patches/charts.h"
#include "renderer/patches/patch_set.h"

namespace lamplighter {

class TexelGrid {
 public:
  static constexpr int kMostAlong = 33;  // most texels along a side
  // Number of texels of a tile, rounded up to whole vectors.
  static constexpr size_t paddedCount(int columns, int rows) {
    return (static_cast<size_t>(columns) * static_cast<size_t>(rows) + kLanes - 1) / kLanes *
           kLanes;
  }

  // columns, rows: from 2 to kMostAlong.
  TexelGrid(const Chart& chart, const Patch& patch, int columns, int rows);

  size_t count() const { return count_; }
  TexelPlaces places() const;  // refers to this object

 private:
  static constexpr size_t kLanes = 8;  // of accumulate()
  using Coordinates = std::array<float, (size_t{kMostAlong} * kMostAlong + kLanes - 1)>;

  const Chart& chart_;
  vec2 min_, max_;  // of the patch
  size_t count_;
  Coordinates u_, w_;
};

}  // namespace lamplighter
