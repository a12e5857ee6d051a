// The actions that the palette lists for a typed text.
#include "ui/panels/command_palette.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "editor/session/register_actions.h"

namespace lamplighter {
namespace {

class PaletteMatches : public testing::Test {
 protected:
  void SetUp() override { addAllActions(registry_); }
  std::vector<std::string> names(const std::string& text) const {
    std::vector<std::string> out;
    for (const Action* action : matchingActions(registry_, text)) out.push_back(action->name);
    return out;
  }
  ActionRegistry registry_;
};

TEST_F(PaletteMatches, AnEmptyTextListsAllActions) {
  EXPECT_EQ(names("").size(), registry_.all().size());
}

TEST_F(PaletteMatches, EveryWordOccursInNameOrLabel) {
  const auto found = names("Dupl LINE");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], "edit.duplicate_line");
}

TEST_F(PaletteMatches, ActionsThatBeginWithTheTextComeFirst) {
  const auto found = names("undo");
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0], "edit.undo");
  EXPECT_TRUE(names("no such action").empty());
}

TEST_F(PaletteMatches, ArgumentsKeepTheNamedActionOnly) {
  const auto found = names("edit.duplicate_line 3 1 0 0");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], "edit.duplicate_line");
}

}  // namespace
}  // namespace lamplighter
