// Labels in the view stay within it and beside panels.
#include "ui/viewport/label_placement.h"

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

const Rect kArea{{100, 50}, {500, 450}};

TEST(LabelPlace, StaysWhereNothingCoversIt) {
  const Rect label{{200, 200}, {260, 230}};
  EXPECT_EQ(clearPlace(label, kArea, {}).min, label.min);
  EXPECT_EQ(clearPlace(label, kArea, {{{300, 300}, {400, 400}}, {}}).min, label.min);
}

TEST(LabelPlace, StaysWithinTheView) {
  const Rect placed = clearPlace({{480, 440}, {540, 470}}, kArea, {});
  EXPECT_EQ(placed.min, vec2(440, 420));
  EXPECT_EQ(placed.max, kArea.max);
  EXPECT_EQ(clearPlace({{0, 0}, {60, 30}}, kArea, {}).min, kArea.min);
}

TEST(LabelPlace, MovesBesideAPanelByTheShortestWay) {
  const Rect panel{{300, 300}, {490, 440}};
  EXPECT_EQ(clearPlace({{290, 350}, {350, 380}}, kArea, {panel}).min, vec2(240, 350));
  EXPECT_EQ(clearPlace({{400, 290}, {460, 320}}, kArea, {panel}).min, vec2(400, 270));
}

TEST(LabelPlace, FindsACornerBetweenTwoPanels) {
  const std::vector<Rect> panels{{{150, 50}, {500, 300}}, {{200, 290}, {500, 450}}};
  const Rect placed = clearPlace({{190, 280}, {250, 310}}, kArea, panels);
  EXPECT_EQ(placed.min, vec2(140, 300));
}

TEST(LabelPlace, StaysIfPanelsCoverTheWholeView) {
  EXPECT_EQ(clearPlace({{200, 200}, {260, 230}}, kArea, {kArea}).min, vec2(200, 200));
}

}  // namespace
}  // namespace lamplighter
