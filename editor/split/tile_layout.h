// The layout of tiles of a view: all of one size, in rows, with lines of text under each.
#pragma once

#include "editor/tools/viewport_input.h"
#include "renderer/scene/scene.h"

namespace lamplighter {

struct TileLayout {
  int count = 1, columns = 1;
  glm::ivec2 size{0};  // of a picture [px]
  glm::ivec2 step{0};  // from a tile to the next, with gap and text [px]

  // The upper left corner of a tile's picture, in pixels of the view.
  vec2 origin(int tile) const;
  // The tile whose picture is there; kNone: none.
  int at(const vec2& point) const;
};

inline constexpr int kTileGap = 6;    // around tiles [px]
inline constexpr int kTileLines = 3;  // of text under a tile: its name and two of figures

// Fills an area of a view [px]. Tiles have about the proportions of the area. lineHeight: of the
// text [px].
TileLayout layOutTiles(const glm::ivec2& area, int count, float lineHeight);

// Maps input over any tile to the view. A drag stays with the tile where it began.
class TilePointer {
 public:
  ViewportInput inTile(const ViewportInput& input, const TileLayout& layout);

 private:
  int tile_ = 0;
};

}  // namespace lamplighter
