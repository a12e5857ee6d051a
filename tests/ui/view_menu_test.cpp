// The menu View and its keys. Runs without a window.
#include "tests/ui/driven_window.h"

namespace lamplighter {
namespace {

class ViewMenu : public testing::Test, protected test::DrivenWindow {
 protected:
  void SetUp() override { open(test::litFloor()); }
  DebugView view() { return session().display().view(); }
};

TEST_F(ViewMenu, EveryViewIsListedAndCanBeChosen) {
  for (const DebugViewInfo& info : debugViews()) {
    SCOPED_TRACE(info.name);
    click("menu/View");
    if (isOfEngine(info.view)) click(info.method.empty() ? "menu/Engine" : "menu/Method");
    click(std::string("menu/view.") + info.name);
    EXPECT_EQ(view(), info.view);
    EXPECT_NE(shows("status/view"), info.view == DebugView::lit);
  }
  // A narrow status line has no space for both this and the problem of the last view.
  session().display().setView(DebugView::lit);
  click("menu/View");
  click("menu/view.vpls");
  frames(2);
  EXPECT_TRUE(session().display().showsVpls());
  EXPECT_TRUE(shows("status/vpl"));
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
