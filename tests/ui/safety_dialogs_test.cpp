// The dialogs that stand between the user and lost work, driven as a hand would, without a window.
#include <fstream>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/scene/gltf_io.h"
#include "tests/support/gltf_files.h"
#include "tests/support/scenes.h"
#include "ui/app/application.h"
#include "ui/platform/headless.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<Session> newSession() {
  return std::make_unique<Session>(std::make_unique<FrameRenderer>(makeCpuBackend()));
}

class SafetyDialogs : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  fs::path level_ = folder_.path() / "level.gltf", state_ = folder_.path() / "state";
  Headless platform_{960, 600, false};
  Application app_{platform_, newSession()};

  void SetUp() override {
    Scene scene;
    test::addMesh(scene, test::squareMesh(4.0f));
    test::addRectangleLight(scene, vec3(0, 2, 0), vec2(1.0f), vec3(5.0f));
    saveGltf(scene, level_);
    app_.setTimeStep(1.0f / 60.0f);
    session().document().render.values.set("vpls", 8);
    session().document().render.values.set("map_resolution", 16);
    app_.openNow(level_);
    frames(3);
  }
  Session& session() { return app_.session(); }
  // What a process leaves that is killed after two edits.
  void leaveWork() const {
    const auto killed = newSession();
    killed->keepJournal(state_, 1, [] { return int64_t{1'000'000'000}; });
    killed->open(loadGltf(level_).scene, level_, {});
    killed->runAction("light.add sphere");
    killed->runAction("edit.rename lost");
  }
  void start() {
    session().keepJournal(state_, 2, [] { return int64_t{1'000'000'001}; });
    frames(3);
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) app_.frame();
  }
  bool shows(const std::string& widget) const { return app_.widgets().find(widget) != nullptr; }
  void click(const std::string& widget) {
    ASSERT_TRUE(shows(widget)) << widget;
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
    frames(2);  // what is shown is known a frame later
  }
  void act(const std::string& text) {
    InputEvent event{EventKind::action};
    event.text = text;
    app_.input().push(event);
    frames(3);
  }
};

TEST_F(SafetyDialogs, NothingIsOfferedWhereNothingIsLeft) {
  start();
  EXPECT_FALSE(shows("recovery/recover"));
}

TEST_F(SafetyDialogs, RecoverTakesTheWorkUp) {
  leaveWork();
  start();
  click("recovery/recover");
  EXPECT_FALSE(shows("recovery/recover"));
  EXPECT_EQ(session().document().scene.nodes.back().name, "lost");
  EXPECT_TRUE(session().modified());
}

TEST_F(SafetyDialogs, DiscardDeletesIt) {
  leaveWork();
  start();
  click("recovery/discard");
  EXPECT_FALSE(shows("recovery/discard"));
  EXPECT_TRUE(fs::is_empty(state_));
  EXPECT_EQ(session().document().scene.nodes.size(), 2u);
}

TEST_F(SafetyDialogs, LaterLeavesItForTheNextStart) {
  leaveWork();
  start();
  click("recovery/later");
  EXPECT_FALSE(shows("recovery/later"));
  frames(5);
  EXPECT_FALSE(shows("recovery/later"));
  EXPECT_EQ(findRecoverable(state_).size(), 1u);
}

TEST_F(SafetyDialogs, AChangedFileIsAskedAbout) {
  act("light.add disk");
  std::ofstream(level_, std::ios::app) << ' ';
  const std::string theirs = test::readText(level_);
  act("file.save");
  click("dialog/cancel");
  EXPECT_EQ(test::readText(level_), theirs);
  EXPECT_TRUE(session().modified());
  act("file.save");
  click("dialog/overwrite");
  EXPECT_FALSE(shows("dialog/overwrite"));
  EXPECT_FALSE(session().modified());
  EXPECT_EQ(loadGltf(level_).scene.nodes.size(), 3u);
}

}  // namespace
}  // namespace lamplighter
