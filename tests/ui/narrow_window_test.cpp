// Windows that are too small for everything leave out labels and tools of the toolbar, and the less
// important parts of the status line. Runs without a window.
#include <gtest/gtest.h>

#include "renderer/base/error.h"
#include "tests/ui/driven_window.h"
#include "ui/platform/ui_scale.h"
#include "ui/widgets/value_slider.h"

namespace lamplighter {
namespace {

class Editor : public test::DrivenWindow {
 public:
  Editor(int width, float scale, int height = 600) : DrivenWindow(width, height, scale) {
    open(test::litFloor());
  }
  float right(const std::string& widget) { return place(widget)->rect.max.x; }
};

TEST(NarrowWindow, TheToolbarLeavesOutLabelsBeforeTools) {
  Editor wide(1600, 1.0f), narrow(800, 1.0f);
  for (const char* last : {"toolbar/select", "toolbar/redo", "toolbar/view.histogram"}) {
    ASSERT_TRUE(wide.shows(last)) << last;
    ASSERT_TRUE(narrow.shows(last)) << last;
    EXPECT_LE(narrow.right(last), 800.0f) << last;
  }
  EXPECT_FALSE(wide.shows("toolbar/more"));
  EXPECT_FALSE(narrow.shows("toolbar/more"));
  EXPECT_LT(narrow.right("toolbar/view.histogram"), wide.right("toolbar/view.histogram"));
}

TEST(NarrowWindow, ToolsThatDoNotFitAreInAMenuThatWorks) {
  Editor editor(640, 2.0f);
  ASSERT_TRUE(editor.shows("toolbar/more"));
  EXPECT_LE(editor.right("toolbar/more"), 640.0f);
  EXPECT_FALSE(editor.shows("toolbar/view.histogram"));
  editor.click("toolbar/more");
  editor.frames(3);
  ASSERT_TRUE(editor.shows("toolbar/view.histogram"));
  EXPECT_FALSE(editor.session().display().showsHistogram());
  editor.click("toolbar/view.histogram");
  EXPECT_TRUE(editor.session().display().showsHistogram());
}

TEST(NarrowWindow, TheStatusLineKeepsItsMostImportantParts) {
  Editor wide(1600, 1.0f), narrow(640, 2.0f);
  for (const char* part : {"status/settled", "status/time", "status/vpls", "status/backend"})
    EXPECT_TRUE(wide.shows(part)) << part;
  EXPECT_TRUE(narrow.shows("status/settled"));
  EXPECT_FALSE(narrow.shows("status/backend"));
  ASSERT_TRUE(narrow.shows("status/message"));
  EXPECT_LE(narrow.right("status/message"), 640.0f);
  EXPECT_LE(narrow.right("status/settled"), narrow.place("status/message")->rect.min.x);
}

TEST(NarrowWindow, TheLightTablesButtonsStayInThePanel) {
  Editor editor(1280, 2.0f, 1000);
  editor.session().runAction("panel.lights");
  editor.frames(3);
  const float edge = editor.place("splitter/bottom")->rect.max.x;
  for (const char* name : {"lights/value", "lights/set", "lights/offset", "lights/colour",
                           "lights/solo", "lights/set_group", "lights/ungroup"}) {
    ASSERT_TRUE(editor.shows(name)) << name;
    EXPECT_LE(editor.right(name), edge) << name;
  }
}

TEST(NarrowWindow, DialogsFitTheWindow) {
  Editor editor(1280, 2.0f);
  editor.act("file.open");
  editor.frames(1);
  ASSERT_TRUE(editor.shows("dialog/ok"));
  EXPECT_LE(editor.place("dialog/ok")->rect.max.y, 600.0f);
  EXPECT_GE(editor.place("dialog/up")->rect.min.y, 0.0f);
}

TEST(ValueSlider, IsFilledUpToTheValue) {
  EXPECT_FLOAT_EQ(sliderShare(5.0f, 0.0f, 10.0f, false, 0.1f), 0.5f);
  EXPECT_FLOAT_EQ(sliderShare(-16.0f, -16.0f, 16.0f, false, 0.1f), 0.0f);
  EXPECT_FLOAT_EQ(sliderShare(10.0f, 1.0f, 100.0f, true, 0.1f), 0.5f);
  // A logarithmic scale cannot start at 0, so it starts at 0.1.
  EXPECT_FLOAT_EQ(sliderShare(0.0f, 0.0f, 1000.0f, true, 0.1f), 0.0f);
  EXPECT_FLOAT_EQ(sliderShare(10.0f, 0.0f, 1000.0f, true, 0.1f), 0.5f);
  EXPECT_FLOAT_EQ(sliderShare(20.0f, 0.0f, 10.0f, false, 0.1f), 1.0f);
}

TEST(UiScale, IsANumberWithinItsLimits) {
  EXPECT_FLOAT_EQ(parseUiScale("1.5"), 1.5f);
  EXPECT_FLOAT_EQ(parseUiScale("4"), 4.0f);
  for (const char* bad : {"", "two", "2x", "0", "-1", "5", "nan", "inf"})
    EXPECT_THROW(parseUiScale(bad), InputError) << bad;
}

}  // namespace
}  // namespace lamplighter
