// What gives way in windows that are too small for all: labels and ends of the toolbar, the less
// important parts of the status line. Driven without a window.
#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/error.h"
#include "tests/support/scenes.h"
#include "ui/app/application.h"
#include "ui/panels/value_slider.h"
#include "ui/platform/headless.h"
#include "ui/platform/ui_scale.h"

namespace lamplighter {
namespace {

class Editor {
 public:
  Editor(int width, float scale, int height = 600) : platform_(width, height, false, scale) {
    Scene scene;
    test::addMesh(scene, test::squareMesh(4.0f));
    test::addRectangleLight(scene, vec3(0, 2, 0), vec2(1.0f), vec3(5.0f));
    app_.setTimeStep(1.0f / 60.0f);
    app_.session().document().render.values.set("vpls", 8);
    app_.session().document().render.values.set("map_resolution", 16);
    frames(2);
    app_.session().open(std::move(scene), "test.gltf", {});
    frames(3);
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) app_.frame();
  }
  void click(const std::string& widget) {
    InputEvent move{EventKind::pointer};
    move.target = widget;
    move.position = vec2(0.5f);
    app_.input().push(move);
    frames(2);
    for (const bool down : {true, false}) {
      InputEvent button{EventKind::button};
      button.down = down;
      app_.input().push(button);
      frames(2);
    }
  }
  bool has(const std::string& widget) { return place(widget) != nullptr; }
  const WidgetMap::Place* place(const std::string& widget) { return app_.widgets().find(widget); }
  float right(const std::string& widget) { return place(widget)->rect.max.x; }
  Application& app() { return app_; }

 private:
  Headless platform_;
  Application app_{platform_,
                   std::make_unique<Session>(std::make_unique<FrameRenderer>(makeCpuBackend()))};
};

TEST(NarrowWindow, TheToolbarLeavesOutLabelsBeforeTools) {
  Editor wide(1600, 1.0f), narrow(800, 1.0f);
  for (const char* last : {"toolbar/select", "toolbar/redo", "toolbar/view.histogram"}) {
    ASSERT_TRUE(wide.has(last)) << last;
    ASSERT_TRUE(narrow.has(last)) << last;
    EXPECT_LE(narrow.right(last), 800.0f) << last;
  }
  EXPECT_FALSE(wide.has("toolbar/more"));
  EXPECT_FALSE(narrow.has("toolbar/more"));
  EXPECT_LT(narrow.right("toolbar/view.histogram"), wide.right("toolbar/view.histogram"));
}

TEST(NarrowWindow, ToolsThatDoNotFitAreInAMenuThatWorks) {
  Editor editor(640, 2.0f);
  ASSERT_TRUE(editor.has("toolbar/more"));
  EXPECT_LE(editor.right("toolbar/more"), 640.0f);
  EXPECT_FALSE(editor.has("toolbar/view.histogram"));
  editor.click("toolbar/more");
  editor.frames(3);
  ASSERT_TRUE(editor.has("toolbar/view.histogram"));
  EXPECT_FALSE(editor.app().session().display().showsHistogram());
  editor.click("toolbar/view.histogram");
  EXPECT_TRUE(editor.app().session().display().showsHistogram());
}

TEST(NarrowWindow, TheStatusLineKeepsWhatMattersMost) {
  Editor wide(1600, 1.0f), narrow(640, 2.0f);
  for (const char* part : {"status/settled", "status/time", "status/vpls", "status/backend"})
    EXPECT_TRUE(wide.has(part)) << part;
  EXPECT_TRUE(narrow.has("status/settled"));
  EXPECT_FALSE(narrow.has("status/backend"));
  ASSERT_TRUE(narrow.has("status/message"));
  EXPECT_LE(narrow.right("status/message"), 640.0f);
  EXPECT_LE(narrow.right("status/settled"), narrow.place("status/message")->rect.min.x);
}

TEST(NarrowWindow, TheLightTablesButtonsStayInThePanel) {
  Editor editor(1280, 2.0f, 1000);
  editor.app().session().runAction("panel.lights");
  editor.frames(3);
  const float edge = editor.place("splitter/bottom")->rect.max.x;
  for (const char* name : {"lights/value", "lights/set", "lights/offset", "lights/colour",
                           "lights/solo", "lights/set_group", "lights/ungroup"}) {
    ASSERT_TRUE(editor.has(name)) << name;
    EXPECT_LE(editor.right(name), edge) << name;
  }
}

TEST(NarrowWindow, DialogsFitTheWindow) {
  Editor editor(1280, 2.0f);
  InputEvent open{EventKind::action};
  open.text = "file.open";
  editor.app().input().push(open);
  editor.frames(4);
  ASSERT_TRUE(editor.has("dialog/ok"));
  EXPECT_LE(editor.place("dialog/ok")->rect.max.y, 600.0f);
  EXPECT_GE(editor.place("dialog/up")->rect.min.y, 0.0f);
}

TEST(ValueSlider, IsFilledAsFarAsTheValueGoes) {
  EXPECT_FLOAT_EQ(sliderShare(5.0f, 0.0f, 10.0f, false, 0.1f), 0.5f);
  EXPECT_FLOAT_EQ(sliderShare(-16.0f, -16.0f, 16.0f, false, 0.1f), 0.0f);
  EXPECT_FLOAT_EQ(sliderShare(10.0f, 1.0f, 100.0f, true, 0.1f), 0.5f);
  // From 0 a logarithm has no beginning: 0.1 stands for it.
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
