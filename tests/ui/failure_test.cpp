// An exception in a part of a frame does not end the editor. Runs without a window.
#include <new>
#include <stdexcept>

#include "editor/recovery/recovery.h"
#include "editor/session/user_state.h"
#include "renderer/base/error.h"
#include "tests/support/failing_kernels.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/ui/driven_window.h"

namespace lamplighter {
namespace {

class Failure : public testing::Test, protected test::DrivenWindow {
 protected:
  void SetUp() override { open(test::litFloor()); }
  uint64_t hash() { return documentHash(session().document()); }
  int messages(const std::string& text) {
    int count = 0;
    for (const Notice& n : session().home().notices.all())
      if (n.text.find(text) != std::string::npos) count += n.count;
    return count;
  }
};

TEST_F(Failure, AFrameThatCannotBeRenderedKeepsDocumentAndJournal) {
  const test::TemporaryFolder folder;
  session().keepJournal(folder.path(), 7, [] { return int64_t{1'000'000}; });
  const auto hooks = std::make_shared<test::KernelHooks>();
  hooks->compose = [] { throw std::bad_alloc(); };
  session().renderer().setBackend(test::failingBackend(hooks));
  act("light.add sphere");
  const uint64_t added = hash();
  frames(60);
  EXPECT_EQ(messages("out of memory"), 1);
  act("object.move 1 0 0");
  act("edit.undo");
  EXPECT_EQ(hash(), added);
  EXPECT_TRUE(shows("viewport"));

  hooks->compose = [] {};
  act("object.move 0 0 1");
  frames(3);
  EXPECT_EQ(session().renderError(), "");
  const uint64_t last = hash();
  session().crashRecovery() = {};  // as after a crash: only the lock disappears
  const auto found = findRecoverable(folder.path());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(documentHash(recover(found.front().folder).document), last);
}

TEST_F(Failure, AMenuThatThrowsLeavesTheOtherPanels) {
  act("light.add disk");
  const uint64_t before = hash();
  Action& undo = session().actions().add(*session().actions().find("edit.undo"));
  const auto enabled = std::exchange(
      undo.enabled, [](const Session&) -> bool { throw std::runtime_error("of a menu"); });
  click("menu/Edit");
  frames(60);
  EXPECT_EQ(messages("Menus: of a menu"), 1);
  EXPECT_FALSE(shows("menu/edit.redo"));
  EXPECT_TRUE(shows("toolbar/undo"));
  EXPECT_TRUE(shows("status/settled"));
  EXPECT_TRUE(shows("viewport"));
  EXPECT_EQ(hash(), before);
  EXPECT_TRUE(session().editing().canUndo());

  undo.enabled = enabled;
  frames(3);
  ASSERT_TRUE(shows("menu/edit.undo"));
  click("menu/edit.undo");
  EXPECT_NE(hash(), before);
}

TEST_F(Failure, AnActionThatThrowsIsUndone) {
  Action action;
  action.name = "test.fail";
  action.run = [](Session& session, const std::vector<std::string>&) {
    Transaction edit = session.editing().begin("Fail");
    edit.sky().scale = 2.0f;
    throw std::bad_alloc();
  };
  session().actions().add(std::move(action));
  const uint64_t before = hash();
  act("test.fail");
  EXPECT_EQ(hash(), before);
  EXPECT_EQ(messages("out of memory"), 1);
  EXPECT_FALSE(session().editing().canUndo());
}

TEST_F(Failure, EndsAReplay) {
  app().setReplaying(true);
  InputEvent event{EventKind::action};
  event.text = "no.such.action";
  app().input().push(event);
  EXPECT_THROW(app().frame(), InputError);
}

}  // namespace
}  // namespace lamplighter
