// Tiles in rows, with captions.
#include "editor/split/tile_sheet.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "editor/debug_views/look.h"

namespace lamplighter {
namespace {

Tile tile(uint8_t grey, std::vector<std::string> figures) {
  Tile t{Image8(40, 20), "many_lights", std::move(figures)};
  std::ranges::fill(t.picture.pixels, grey);
  return t;
}

TEST(TileSheet, PutsTilesInRowsWithRoomForTheLongestCaption) {
  const Font font(look::kTextFont, 12, "the test");
  const std::vector<Tile> tiles = {tile(10, {"settled"}), tile(90, {}), tile(200, {"a", "b"})};
  const Image8 sheet = tileSheet(tiles, 2, font);
  const int caption = static_cast<int>(std::ceil(font.lineHeight())) * 3;
  EXPECT_EQ(sheet.width, 6 + 2 * (40 + 6));
  EXPECT_EQ(sheet.height, 6 + 2 * (20 + caption + 6 + 6));
  EXPECT_EQ(sheet.at(6, 6)[0], 10);
  EXPECT_EQ(sheet.at(6 + 46 + 39, 6 + 19)[1], 90);
  EXPECT_EQ(sheet.at(6, 6 + 20 + caption + 12)[2], 200);
  // No more columns than tiles.
  EXPECT_EQ(tileSheet(std::span(tiles).first(1), 5, font).width, 6 + 46);
  EXPECT_EQ(tileSheet({}, 3, font).width, 0);
}

// Text too long for a tile does not run into the next one.
TEST(TileSheet, CutsCaptionsOff) {
  const Font font(look::kTextFont, 12, "the test");
  const std::vector<Tile> tiles = {tile(10, {std::string(200, 'M')}), tile(10, {})};
  const Image8 sheet = tileSheet(tiles, 2, font);
  const int below = 29 + static_cast<int>(std::ceil(font.lineHeight())) + 1;  // the titles
  for (int y = below; y < sheet.height; ++y)
    for (int x = 46; x < sheet.width; ++x)
      EXPECT_EQ(sheet.at(x, y)[0], sheet.at(0, 0)[0]) << x << " " << y;
}

}  // namespace
}  // namespace lamplighter
