// Toasts, the file dialog, settings and panels, used by keys only. Runs without a window.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <imgui.h>

#include "editor/session/user_state.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "tests/support/scenes/scenes.h"
#include "ui/app/application.h"
#include "ui/platform/headless.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

class Home : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("lamplighter_home_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "levels/old");
    for (const char* name :
         {"levels/attic.gltf", "levels/cellar.glb", "levels/notes.txt", "levels/old/hall.gltf"})
      std::ofstream(folder_ / name) << R"({"asset":{"version":"2.0"}})";
    Scene scene;
    test::addMesh(scene, test::squareMesh(4.0f));
    test::addRectangleLight(scene, vec3(0, 2, 0), vec2(1.0f), vec3(5.0f));
    app_.setReplaying(true);
    app_.setTimeStep(1.0f / 60.0f);
    RenderSettings render = session().document().render;
    render.values.set("vpls", 8);
    render.values.set("map_resolution", 16);
    session().editing().setInitialRender(std::move(render));
    frames(2);
    session().open(std::move(scene), folder_ / "levels/attic.gltf", {});
    frames(2);
  }
  void TearDown() override { fs::remove_all(folder_); }
  Session& session() { return app_.session(); }
  void frames(int count) {
    for (int i = 0; i < count; ++i) app_.frame();
  }
  void tap(Key key, std::vector<Key> held = {}) {
    held.push_back(key);
    for (const Key k : held) push(k, true);
    frames(2);
    for (const Key k : held) push(k, false);
    frames(3);
  }
  void push(Key key, bool down) {
    InputEvent event{EventKind::key};
    event.key = key;
    event.down = down;
    app_.input().push(event);
  }
  void type(const std::string& text) {
    InputEvent event{EventKind::text};
    event.text = text;
    app_.input().push(event);
    frames(2);
  }
  bool has(const std::string& widget) { return app_.widgets().find(widget) != nullptr; }

  Headless platform_{1280, 720, false};
  Application app_{platform_,
                   std::make_unique<Session>(std::make_unique<FrameRenderer>(makeCpuBackend()))};
  fs::path folder_;
};

TEST_F(Home, AToastAppearsAndDisappears) {
  frames(600);
  EXPECT_FALSE(has("toast/0"));
  session().setStatus("Something happened");
  frames(2);
  EXPECT_TRUE(has("toast/0"));
  frames(4 * 60 + 5);
  EXPECT_FALSE(has("toast/0"));
  session().setStatus("It failed", NoticeKind::error);
  frames(4 * 60 + 5);
  EXPECT_TRUE(has("toast/0")) << "errors are shown twice as long";
  frames(4 * 60 + 5);
  EXPECT_FALSE(has("toast/0"));
  session().runAction("settings.set toasts=false");
  session().setStatus("More happened");
  frames(2);
  EXPECT_FALSE(has("toast/0"));
  session().runAction("panel.log");
  frames(3);
  EXPECT_TRUE(has("log/line 2")) << "the log contains all messages";
}

TEST_F(Home, TheFileDialogIsUsedByKeysOnly) {
  tap(Key::o, {Key::ctrl});
  ASSERT_TRUE(has("dialog/ok"));
  EXPECT_TRUE(has("dialog/old"));
  EXPECT_TRUE(has("dialog/attic.gltf"));
  EXPECT_FALSE(has("dialog/notes.txt")) << "another kind of file";
  type("CELL");
  frames(2);
  EXPECT_TRUE(has("dialog/cellar.glb"));
  EXPECT_FALSE(has("dialog/attic.gltf"));
  tap(Key::enter);
  EXPECT_FALSE(has("dialog/ok"));
  EXPECT_EQ(session().document().path.filename(), "cellar.glb");
}

TEST_F(Home, KeysNavigateFoldersInTheFileDialog) {
  tap(Key::o, {Key::ctrl});
  tap(Key::down);
  tap(Key::enter);  // opens "old", the first entry
  EXPECT_TRUE(has("dialog/hall.gltf"));
  tap(Key::backspace);
  EXPECT_TRUE(has("dialog/attic.gltf"));
  type((folder_ / "levels/old").string());
  tap(Key::enter);
  EXPECT_TRUE(has("dialog/hall.gltf"));
  tap(Key::up, {Key::alt});
  EXPECT_TRUE(has("dialog/attic.gltf"));
  tap(Key::n1, {Key::ctrl});  // the folder of the last level
  EXPECT_TRUE(has("dialog/attic.gltf"));
  tap(Key::escape);
  EXPECT_FALSE(has("dialog/ok"));
}

TEST_F(Home, FavouriteFoldersAreListed) {
  session().home().preferences.toggleFavourite(folder_ / "levels/old");
  tap(Key::o, {Key::ctrl});
  tap(Key::n1, {Key::ctrl});
  EXPECT_TRUE(has("dialog/hall.gltf"));
}

TEST_F(Home, KeysNavigatePanelsAndMenus) {
  EXPECT_FALSE(ImGui::GetIO().NavVisible);
  tap(Key::f6);
  EXPECT_TRUE(ImGui::GetIO().NavVisible);
  tap(Key::space);  // presses the first button of the toolbar and does not toggle the reference
  EXPECT_NE(session().document().render.method, "reference");
  tap(Key::f10);
  tap(Key::down);
  EXPECT_TRUE(has("menu/file.save")) << "the first menu is open";
  tap(Key::escape);
  tap(Key::escape);
  tap(Key::escape);
  EXPECT_FALSE(has("menu/file.save"));
}

TEST_F(Home, AnObjectIsSelectedByKeysInTheOutliner) {
  session().select({});
  tap(Key::f6);
  tap(Key::f6);  // past the toolbar
  for (int i = 0; i < 3; ++i) tap(Key::down);
  tap(Key::enter);
  EXPECT_EQ(session().document().selection.size(), 1u);
}

TEST_F(Home, EnterRunsTheMarkedMenuItem) {
  tap(Key::f10);
  for (int i = 0; i < 2; ++i) tap(Key::right);  // the menu Light
  tap(Key::down);
  for (int i = 0; i < 2; ++i) tap(Key::down);  // the light table
  tap(Key::enter);
  EXPECT_TRUE(session().lighting().showsTable);
}

TEST_F(Home, SettingsAreSavedForAUser) {
  std::ofstream(folder_ / "keys.json") << R"({"tool.move": "P", "no.such": "Q"})";
  auto files = std::make_unique<UserFiles>(folder_);
  Preferences read = files->readPreferences();
  read.setText("thumbnail_size", "60");
  app_.setUser(std::move(files), std::move(read));
  EXPECT_EQ(session().actions().textForKey(Key::p, {}), "tool.move");
  ASSERT_FALSE(session().home().notices.all().empty());
  EXPECT_EQ(session().home().notices.all().back().kind, NoticeKind::warning);
  EXPECT_NE(session().home().notices.all().back().text.find("no.such"), std::string::npos);
  session().runAction("lights.unit cd");
  session().home().preferences.addRecent("/levels/attic.gltf");
  frames(60);
  UserFiles again(folder_);
  const Preferences kept = again.readPreferences();
  EXPECT_EQ(kept.settings().lightUnit, "cd");
  EXPECT_EQ(kept.settings().thumbnailSize, 60);
  ASSERT_EQ(kept.recentFiles.size(), 1u);
  EXPECT_EQ(kept.recentFiles[0], "/levels/attic.gltf");
}

TEST_F(Home, ShortcutsWithArgumentsRun) {
  tap(Key::n4, {Key::ctrl});
  ASSERT_EQ(session().document().scene.bookmarks.size(), 1u);
  EXPECT_EQ(session().document().scene.bookmarks[0].slot, 4);
  const View stored = session().view();
  tap(Key::up, {Key::ctrl});
  EXPECT_NE(session().view(), stored);
  tap(Key::n4);
  EXPECT_EQ(session().view(), stored);
}

TEST_F(Home, TheUiScaleSettingMultipliesTheScaleOfTheScreen) {
  const float before = app_.widgets().find("toolbar/select")->rect.size().y;
  session().runAction("view.ui_scale 2");
  frames(3);
  EXPECT_NEAR(app_.widgets().find("toolbar/select")->rect.size().y, 2.0f * before, 3.0f);
}

TEST_F(Home, SettingsMoveTheBordersOfPanels) {
  session().runAction("settings.set left_width=300");
  frames(3);
  EXPECT_NEAR(app_.widgets().find("splitter/left")->rect.min.x, 300.0f, 1.0f);
  session().runAction("settings.reset");
  frames(3);
  EXPECT_NEAR(app_.widgets().find("splitter/left")->rect.min.x, 232.0f, 1.0f);
}

TEST_F(Home, TheSettingsPanelOpensAndCloses) {
  tap(Key::comma, {Key::ctrl});
  ASSERT_TRUE(has("settings/ui_scale"));
  tap(Key::escape);
  EXPECT_FALSE(has("settings/ui_scale"));
}

TEST_F(Home, OnlyOnePanelIsBelowTheView) {
  session().runAction("panel.assets");
  frames(3);
  EXPECT_TRUE(has("assets/folder"));
  session().runAction("panel.lights");
  frames(3);
  EXPECT_FALSE(has("assets/folder"));
  EXPECT_TRUE(has("lights/value"));
  session().runAction("panel.log");
  frames(3);
  EXPECT_FALSE(has("lights/value"));
  EXPECT_TRUE(has("log/clear"));
}

}  // namespace
}  // namespace lamplighter
