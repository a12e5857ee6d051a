// How the window is divided, with and without what lies below the view.
#include "ui/app/layout.h"

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

TEST(Layout, TheLightTableTakesFromOutlinerAndView) {
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
    // The right column is as it was.
    EXPECT_EQ(split.render.max, plain.render.max);
    EXPECT_EQ(split.inspector.min, plain.inspector.min);
  }
}

}  // namespace
}  // namespace lamplighter
