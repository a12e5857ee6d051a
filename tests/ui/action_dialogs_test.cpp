// Actions that ask for a file, a folder or a name open its dialog when run from menus, panels, keys
// and the command palette. Runs without a window.
#include <filesystem>
#include <fstream>
#include <memory>

#include "editor/session/user_state.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/ui/driven_window.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kNoteExtensions[] = {".note"};

class ActionDialogs : public testing::Test, protected test::DrivenWindow {
 protected:
  test::TemporaryFolder folder_;

  void SetUp() override {
    frames(2);
    session().open(test::litFloor(), folder_.path() / "level.gltf", {});
    frames(3);
  }
  void type(const std::string& text) {
    InputEvent event{EventKind::text};
    event.text = text;
    app().input().push(event);
    frames(3);
  }
  void press(Key k) {
    key(k, true);
    key(k, false);
    frames(3);
  }
  void runFromPalette(const std::string& name) {
    act("app.palette");
    type(name);
    press(Key::enter);
  }
  // Adds an action that the ui does not know, and returns the arguments that it receives.
  std::shared_ptr<std::vector<std::string>> addAction(ActionAsk asks) {
    auto received = std::make_shared<std::vector<std::string>>();
    session().actions().add(
        {.name = "test.note",
         .label = "Note",
         .usage = "NOTE",
         .help = "Takes a note.",
         .run = [received](Session&, const auto& arguments) { *received = arguments; },
         .asks = std::move(asks)});
    return received;
  }
};

TEST_F(ActionDialogs, AnAddedActionAsksForAFileToOpen) {
  std::ofstream(folder_.path() / "a \"b\".note") << "x";
  std::ofstream(folder_.path() / "other.txt") << "x";
  const auto received = addAction({.title = "Open a note", .extensions = kNoteExtensions});
  runFromPalette("test.note");
  ASSERT_TRUE(shows("dialog/a \"b\".note"));
  EXPECT_FALSE(shows("dialog/other.txt"));
  click("dialog/a \"b\".note");
  click("dialog/ok");
  EXPECT_FALSE(shows("dialog/ok"));
  ASSERT_EQ(received->size(), 1u);
  EXPECT_EQ(fs::path(received->front()), folder_.path() / "a \"b\".note");
}

TEST_F(ActionDialogs, AFileToSaveGetsTheFirstExtension) {
  const auto received = addAction(
      {.kind = ActionAsk::Kind::saveFile,
       .title = "Save a note",
       .extensions = kNoteExtensions,
       .suggested = [this](const Session&) { return (folder_.path() / "first").string(); }});
  runFromPalette("test.note");
  click("dialog/ok");
  ASSERT_EQ(received->size(), 1u);
  EXPECT_EQ(fs::path(received->front()), folder_.path() / "first.note");
}

TEST_F(ActionDialogs, AnAddedActionAsksForAName) {
  const auto received = addAction(
      {.kind = ActionAsk::Kind::name, .title = "Name the note", .suggested = [](const Session&) {
         return std::string("old name");
       }});
  runFromPalette("test.note");
  ASSERT_TRUE(shows("dialog/name"));
  type("a new name");
  press(Key::enter);
  EXPECT_FALSE(shows("dialog/name"));
  EXPECT_EQ(*received, std::vector<std::string>{"a new name"});
  runFromPalette("test.note");
  click("dialog/ok");
  EXPECT_EQ(*received, std::vector<std::string>{"old name"});
}

TEST_F(ActionDialogs, CancelRunsNothing) {
  const auto received = addAction({.title = "Open a note", .extensions = kNoteExtensions});
  act("test.note");
  click("dialog/cancel");
  EXPECT_FALSE(shows("dialog/cancel"));
  EXPECT_TRUE(received->empty());
}

TEST_F(ActionDialogs, TheTimelineIsExported) {
  runFromPalette("timeline.export");
  ASSERT_TRUE(shows("dialog/ok"));
  click("dialog/ok");
  EXPECT_TRUE(fs::exists(folder_.path() / "timeline.json"));
}

TEST_F(ActionDialogs, TheFolderOfAssetsIsChosen) {
  act("asset.folder");
  click("dialog/ok");
  EXPECT_EQ(session().home().preferences.assetFolder, folder_.path());
}

TEST_F(ActionDialogs, RenameNeedsASelectedObject) {
  act("edit.rename");
  EXPECT_FALSE(shows("dialog/name"));
  EXPECT_NE(session().status().find("nothing is selected"), std::string::npos);
  session().select({session().document().scene.nodes.front().id});
  press(Key::f2);
  ASSERT_TRUE(shows("dialog/name"));
  type("ground");
  press(Key::enter);
  EXPECT_EQ(session().document().scene.nodes.front().name, "ground");
}

TEST_F(ActionDialogs, TheInspectorAsksForThePictureOfTheSky) {
  click("sky/kind");
  click("sky/kind/image");
  EXPECT_TRUE(shows("dialog/ok"));
}

TEST_F(ActionDialogs, ALevelWithoutAFileIsSavedUnderAName) {
  session().open(test::litFloor(), {}, {});
  frames(3);
  act("file.save");
  ASSERT_TRUE(shows("dialog/file"));
  click("dialog/file");
  key(Key::ctrl, true);
  press(Key::a);
  key(Key::ctrl, false);
  type((folder_.path() / "saved").string());
  press(Key::enter);
  EXPECT_EQ(session().document().path, folder_.path() / "saved.gltf");
  EXPECT_TRUE(fs::exists(folder_.path() / "saved.gltf"));
}

TEST_F(ActionDialogs, TheSettingsDialogRunsItsActions) {
  session().runAction("settings.set thumbnail_size=60");
  act("settings.show");
  click("settings/reset");
  EXPECT_NE(session().home().preferences.settings().thumbnailSize, 60);
}

}  // namespace
}  // namespace lamplighter
