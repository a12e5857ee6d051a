// Where tiles lie, and input over them.
#include "editor/split/tile_layout.h"

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

TEST(TileLayout, FillsTheAreaWithTilesOfItsProportions) {
  for (const glm::ivec2 area : {glm::ivec2(1280, 720), glm::ivec2(700, 640), glm::ivec2(300, 900)})
    for (const int count : {1, 2, 3, 6}) {
      const TileLayout layout = layOutTiles(area, count, 15.0f);
      EXPECT_EQ(layout.count, count);
      for (int i = 0; i < count; ++i) {
        const vec2 low = layout.origin(i), high = low + vec2(layout.size);
        // With three lines of text below, within the area.
        EXPECT_GE(low.x, 0.0f);
        EXPECT_LE(high.x, static_cast<float>(area.x));
        EXPECT_LE(high.y + 3 * 15.0f, static_cast<float>(area.y));
        for (int j = 0; j < i; ++j) {
          const vec2 other = layout.origin(j);
          EXPECT_TRUE(low.x >= other.x + static_cast<float>(layout.size.x) ||
                      low.y >= other.y + static_cast<float>(layout.size.y) + 3 * 15.0f)
              << i << " and " << j;
        }
      }
    }
  EXPECT_EQ(layOutTiles({1280, 720}, 6, 15.0f).columns, 3);
  EXPECT_EQ(layOutTiles({1280, 720}, 2, 15.0f).columns, 2);
}

// A window that is too small for the text still has tiles.
TEST(TileLayout, TilesHaveAtLeastOnePixel) {
  const TileLayout layout = layOutTiles({20, 10}, 6, 15.0f);
  EXPECT_GE(layout.size.x, 1);
  EXPECT_GE(layout.size.y, 1);
}

TEST(TileLayout, FindsTheTileAtAPoint) {
  const TileLayout layout = layOutTiles({600, 400}, 6, 12.0f);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(layout.at(layout.origin(i)), i);
    EXPECT_EQ(layout.at(layout.origin(i) + vec2(layout.size) - 1.0f), i);
    EXPECT_EQ(layout.at(layout.origin(i) + vec2(2, layout.size.y + 2)), kNone);  // its text
  }
  EXPECT_EQ(layout.at({1, 1}), kNone);
}

TEST(TilePointer, ADragStaysWithTheTileWhereItBegan) {
  const TileLayout layout = layOutTiles({600, 400}, 6, 12.0f);
  TilePointer pointer;
  ViewportInput in;
  in.hovered = true;
  in.pointer = layout.origin(4) + vec2(10, 20);
  EXPECT_EQ(pointer.inTile(in, layout).pointer, vec2(10, 20));
  in.pressed[0] = in.down[0] = true;
  EXPECT_TRUE(pointer.inTile(in, layout).hovered);
  in.pressed[0] = false;
  in.pointer = layout.origin(1) + vec2(3, 4);
  EXPECT_EQ(pointer.inTile(in, layout).pointer, in.pointer - layout.origin(4));
  in.down[0] = false;
  in.released[0] = true;
  EXPECT_EQ(pointer.inTile(in, layout).pointer, in.pointer - layout.origin(4));
  in.released[0] = false;
  EXPECT_EQ(pointer.inTile(in, layout).pointer, vec2(3, 4));
  in.pointer = vec2(0);  // between tiles
  EXPECT_FALSE(pointer.inTile(in, layout).hovered);
}

}  // namespace
}  // namespace lamplighter
