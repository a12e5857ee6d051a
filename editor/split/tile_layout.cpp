#include "editor/split/tile_layout.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {

vec2 TileLayout::origin(int tile) const {
  return vec2(glm::ivec2(kTileGap) + step * glm::ivec2(tile % columns, tile / columns));
}

int TileLayout::at(const vec2& point) const {
  for (int i = 0; i < count; ++i) {
    const vec2 in = point - origin(i);
    if (in.x >= 0.0f && in.y >= 0.0f && in.x < static_cast<float>(size.x) &&
        in.y < static_cast<float>(size.y))
      return i;
  }
  return kNone;
}

TileLayout layOutTiles(const glm::ivec2& area, int count, float lineHeight) {
  const int text = kTileLines * static_cast<int>(std::ceil(lineHeight)) + kTileGap;
  const float wanted = static_cast<float>(area.x) / static_cast<float>(std::max(area.y, 1));
  TileLayout best;
  float nearest = INFINITY;
  for (int columns = 1; columns <= count; ++columns) {
    const int rows = (count + columns - 1) / columns;
    const glm::ivec2 step = (area - kTileGap) / glm::ivec2(columns, rows);
    const glm::ivec2 size = max(step - glm::ivec2(kTileGap, kTileGap + text), glm::ivec2(1));
    const float ratio = static_cast<float>(size.x) / static_cast<float>(size.y);
    const float distance = std::abs(std::log(ratio / wanted));
    if (distance >= nearest) continue;
    nearest = distance;
    best = {count, columns, size, step};
  }
  return best;
}

ViewportInput TilePointer::inTile(const ViewportInput& input, const TileLayout& layout) {
  const bool drags = input.down[0] || input.down[1] || input.down[2];
  const bool begins = input.pressed[0] || input.pressed[1] || input.pressed[2];
  const bool ends = input.released[0] || input.released[1] || input.released[2];
  const int under = layout.at(input.pointer);
  if (under != kNone && (begins || !(drags || ends))) tile_ = under;
  tile_ = std::min(tile_, layout.count - 1);
  ViewportInput result = input;
  result.pointer -= layout.origin(tile_);
  if (under != tile_) result.hovered = false;
  return result;
}

}  // namespace lamplighter
