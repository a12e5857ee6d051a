// The dialogs that prevent the loss of work. Runs without a window.
#include <fstream>

#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/ui/driven_window.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

class SafetyDialogs : public testing::Test, protected test::DrivenWindow {
 protected:
  test::TemporaryFolder folder_;
  fs::path level_ = folder_.path() / "level.gltf", state_ = folder_.path() / "state";

  void SetUp() override {
    saveGltf(test::litFloor(), level_);
    app().openNow(level_);
    frames(3);
  }
  // Leaves the journal of a process that was killed after two edits.
  void leaveWork() const {
    const auto killed = test::newSession();
    killed->keepJournal(state_, 1, [] { return int64_t{1'000'000'000}; });
    killed->open(loadGltf(level_).scene, level_, {});
    killed->runAction("light.add sphere");
    killed->runAction("edit.rename lost");
  }
  void start() {
    session().keepJournal(state_, 2, [] { return int64_t{1'000'000'001}; });
    frames(3);
  }
};

TEST_F(SafetyDialogs, WithoutAJournalNothingIsOffered) {
  start();
  EXPECT_FALSE(shows("recovery/recover"));
}

TEST_F(SafetyDialogs, RecoverRestoresTheWork) {
  leaveWork();
  start();
  click("recovery/recover");
  EXPECT_FALSE(shows("recovery/recover"));
  EXPECT_EQ(session().document().scene.nodes.back().name, "lost");
  EXPECT_TRUE(session().modified());
}

TEST_F(SafetyDialogs, DiscardDeletesTheJournal) {
  leaveWork();
  start();
  click("recovery/discard");
  EXPECT_FALSE(shows("recovery/discard"));
  EXPECT_TRUE(fs::is_empty(state_));
  EXPECT_EQ(session().document().scene.nodes.size(), 2u);
}

TEST_F(SafetyDialogs, LaterKeepsTheJournalForTheNextStart) {
  leaveWork();
  start();
  click("recovery/later");
  EXPECT_FALSE(shows("recovery/later"));
  frames(5);
  EXPECT_FALSE(shows("recovery/later"));
  EXPECT_EQ(findRecoverable(state_).size(), 1u);
}

TEST_F(SafetyDialogs, AFileChangedByOthersNeedsConfirmation) {
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

// Cancelling the save dialog cancels what waited for the save: quitting asks again, and saving
// later does not quit.
TEST_F(SafetyDialogs, CancellingTheSaveDialogCancelsQuitting) {
  session().open(test::litFloor(), "", {});
  act("light.add disk");
  const auto quit = [&] {
    act("app.quit");
    frames(3);  // the question is drawn after the action
  };
  quit();
  click("dialog/save");
  ASSERT_TRUE(shows("dialog/file"));
  click("dialog/cancel");
  EXPECT_FALSE(shows("dialog/file"));
  quit();
  ASSERT_TRUE(shows("dialog/discard"));
  click("dialog/save");
  ASSERT_TRUE(shows("dialog/file"));
  key(Key::escape, true);
  key(Key::escape, false);
  frames(3);
  EXPECT_FALSE(shows("dialog/file"));
  act("file.save_as " + (folder_.path() / "new.gltf").string());
  EXPECT_FALSE(session().modified());
  EXPECT_FALSE(app().finished());
}

}  // namespace
}  // namespace lamplighter
