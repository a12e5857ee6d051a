// Notices: the messages that the user sees.
#include "editor/notices/notices.h"

#include "editor/session/user_state.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

TEST(Notices, RepeatedNoticesAreCounted) {
  Notices notices;
  notices.add(NoticeKind::info, "Saved");
  notices.add(NoticeKind::info, "Saved");
  notices.add(NoticeKind::error, "Saved");
  notices.add(NoticeKind::info, "");
  ASSERT_EQ(notices.all().size(), 2u);
  EXPECT_EQ(notices.all()[0].count, 2);
  EXPECT_LT(notices.all()[0].id, notices.all()[1].id);
}

TEST(Notices, AHintIsReplacedByTheNextNotice) {
  Notices notices;
  notices.add(NoticeKind::info, "Opened");
  notices.add(NoticeKind::hint, "Click there");
  const uint64_t first = notices.all().back().id;
  notices.add(NoticeKind::hint, "Click there");
  ASSERT_EQ(notices.all().size(), 2u);
  EXPECT_EQ(notices.all().back().count, 1) << "repeated hints are not counted";
  EXPECT_GT(notices.all().back().id, first) << "but it is shown again";
  notices.add(NoticeKind::info, "Placed");
  ASSERT_EQ(notices.all().size(), 2u);
  EXPECT_EQ(notices.all().front().text, "Opened");
  EXPECT_EQ(notices.all().back().text, "Placed");
}

TEST(Notices, AreOneLineEachAndLimitedInNumber) {
  Notices notices;
  for (int i = 0; i < 3000; ++i) notices.add(NoticeKind::info, std::to_string(i) + "\nmore");
  EXPECT_LE(notices.all().size(), 1000u);
  EXPECT_EQ(notices.all().back().text, "2999 more");
}

using SessionNotices = test::SessionFixture;

TEST_F(SessionNotices, ReportUndoneStepsAndErrors) {
  session_.runAction("select.name box");
  session_.runAction("object.move 1 2 3");
  session_.runAction("edit.undo");
  EXPECT_EQ(session_.home().notices.all().back().text.rfind("Undid: ", 0), 0u);
  session_.runAction("edit.redo");
  EXPECT_EQ(session_.home().notices.all().back().text.rfind("Redid: ", 0), 0u);
  session_.runAction("object.move nowhere");
  EXPECT_EQ(session_.home().notices.all().back().kind, NoticeKind::error);
  EXPECT_EQ(session_.home().notices.all().back().text, session_.status());
}

}  // namespace
}  // namespace lamplighter
