// Pictures of one view side by side as tiles, with lines of text under each: for comparing methods.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "renderer/image/font.h"
#include "renderer/image/image.h"

namespace lamplighter {

struct Tile {
  Image8 picture;  // display-referred; all tiles of a sheet have the same size
  std::string title;
  std::vector<std::string> figures;  // each one line; cut off at the width of the picture
};

// Draws rows of `columns` tiles. Under each picture there is space for the title and for the
// largest number of lines of any tile.
Image8 tileSheet(std::span<const Tile> tiles, int columns, const Font& font);

}  // namespace lamplighter
