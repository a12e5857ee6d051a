// The division of the window, with and without a panel below the view.
#include "ui/app/layout.h"

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

TEST(Layout, TheLightTableTakesSpaceFromOutlinerAndView) {
  struct Window {
    vec2 size;
    float scale;
  };
  for (const Window& w : {Window{{1280, 720}, 1.0f}, Window{{2560, 1440}, 1.0f},
                          Window{{2560, 1440}, 2.0f}, Window{{700, 500}, 1.0f}}) {
    Layout plain, split;
    plain.divide(w.size, 24.0f * w.scale, w.scale, false);
    split.divide(w.size, 24.0f * w.scale, w.scale, true);
    EXPECT_TRUE(plain.bottom.empty());
    ASSERT_FALSE(split.bottom.empty());
    EXPECT_GE(split.bottom.size().y, 120.0f * w.scale - 1.0f);
    EXPECT_FALSE(split.view.empty());
    EXPECT_LT(split.view.max.y, split.bottom.min.y);
    EXPECT_LT(split.left.max.y, split.bottom.min.y);
    EXPECT_EQ(split.bottom.max.y, split.status.min.y);
    EXPECT_EQ(split.bottom.max.x, split.view.max.x);
    EXPECT_EQ(split.view.min, plain.view.min);
    // The right column does not change.
    EXPECT_EQ(split.render.max, plain.render.max);
    EXPECT_EQ(split.inspector.min, plain.inspector.min);
  }
}

TEST(Layout, SizesAreRestoredAfterASmallWindow) {
  Layout layout;
  layout.divide({1280, 720}, 24.0f, 1.0f, true);
  const Rect left = layout.left, inspector = layout.inspector, bottom = layout.bottom;
  layout.divide({640, 400}, 48.0f, 2.0f, true);
  EXPECT_LT(layout.left.size().x, 2.0f * left.size().x);
  layout.divide({1280, 720}, 24.0f, 1.0f, true);
  EXPECT_EQ(layout.left.size(), left.size());
  EXPECT_EQ(layout.inspector.size(), inspector.size());
  EXPECT_EQ(layout.bottom.size(), bottom.size());
  EXPECT_EQ(layout.sizes(), LayoutSizes());
}

}  // namespace
}  // namespace lamplighter
