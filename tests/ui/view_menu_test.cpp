// The menu View and its keys, driven as a hand would, without a window.
#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "tests/support/scenes.h"
#include "ui/app/application.h"
#include "ui/platform/headless.h"

namespace lamplighter {
namespace {

class ViewMenu : public testing::Test {
 protected:
  void SetUp() override {
    Scene scene;
    test::addMesh(scene, test::squareMesh(4.0f));
    test::addRectangleLight(scene, vec3(0, 2, 0), vec2(1.0f), vec3(5.0f));
    app_.setTimeStep(1.0f / 60.0f);
    Session& session = app_.session();
    session.document().render.values.set("vpls", 8);
    session.document().render.values.set("map_resolution", 16);
    frames(2);
    session.open(std::move(scene), "test.gltf", {});
    frames(2);
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
  void key(Key key, bool down) {
    InputEvent event{EventKind::key};
    event.key = key;
    event.down = down;
    app_.input().push(event);
    frames(1);
  }
  DebugView view() { return app_.session().display().view(); }

  Headless platform_{960, 600, false};
  Application app_{platform_,
                   std::make_unique<Session>(std::make_unique<FrameRenderer>(makeCpuBackend()))};
};

TEST_F(ViewMenu, ListsEveryViewAndSwitchesIt) {
  for (const DebugViewInfo& info : debugViews()) {
    SCOPED_TRACE(info.name);
    click("menu/View");
    if (isOfEngine(info.view)) click("menu/Engine");
    click(std::string("menu/view.") + info.name);
    EXPECT_EQ(view(), info.view);
    EXPECT_EQ(app_.widgets().find("status/view") == nullptr, info.view == DebugView::lit);
  }
  // A narrow window has no room for what the last view says it lacks, and for this.
  app_.session().display().setView(DebugView::lit);
  click("menu/View");
  click("menu/view.vpls");
  frames(2);
  EXPECT_TRUE(app_.session().display().showsVpls());
  EXPECT_NE(app_.widgets().find("status/vpl"), nullptr);
}

TEST_F(ViewMenu, AltAndANumberSwitchTheView) {
  key(Key::alt, true);
  key(Key::n4, true);
  key(Key::n4, false);
  EXPECT_EQ(view(), DebugView::normals);
  key(Key::n1, true);
  key(Key::n1, false);
  key(Key::alt, false);
  EXPECT_EQ(view(), DebugView::lit);
}

}  // namespace
}  // namespace lamplighter
