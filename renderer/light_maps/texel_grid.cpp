#include "renderer/light_maps/texel_grid.h"

#include <algorithm>

namespace lamplighter {
namespace {

// Evenly spaced values including both ends.
void spread(float from, float to, int count, float* out) {
  for (int i = 0; i < count; ++i)
    out[i] = glm::mix(from, to, static_cast<float>(i) / static_cast<float>(count - 1));
}

}  // namespace

TexelGrid::TexelGrid(const Chart& chart, const Patch& patch, int columns, int rows)
    : chart_(chart), min_(patch.min), max_(patch.max), count_(paddedCount(columns, rows)) {
  std::array<float, kMostAlong> heights;
  spread(min_.y, max_.y, rows, heights.data());
  spread(min_.x, max_.x, columns, u_.data());
  float *u = u_.data(), *w = w_.data();
  for (int row = 0; row < rows; ++row, u += columns, w += columns) {
    if (row > 0) std::copy_n(u_.data(), columns, u);
    std::fill_n(w, columns, heights[static_cast<size_t>(row)]);
  }
  // The padding repeats the last texel, so that all lie in the patch.
  std::fill(u, u_.data() + count_, u[-1]);
  std::fill(w, w_.data() + count_, w[-1]);
}

TexelPlaces TexelGrid::places() const {
  return {chart_.origin, chart_.tangent, chart_.bitangent,    chart_.normal,
          min_,          max_,           {u_.data(), count_}, {w_.data(), count_}};
}

}  // namespace lamplighter
