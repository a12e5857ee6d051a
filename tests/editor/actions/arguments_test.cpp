// Words of action texts.
#include "editor/actions/arguments.h"

#include <gtest/gtest.h>

#include "editor/keys/action.h"

namespace lamplighter {
namespace {

TEST(ActionArguments, CallsAreReadAsTheyWereWritten) {
  ActionRegistry actions;
  actions.add({.name = "words", .usage = "WORD…"});
  const Arguments words{"plain", "two words", "a \"quoted\" one", "back\\slash", ""};
  Arguments all{"words"};
  all.insert(all.end(), words.begin(), words.end());
  EXPECT_EQ(actions.parse(callText(all)).arguments, words);
  EXPECT_EQ(callText({"words", "plain"}), "words plain");
}

}  // namespace
}  // namespace lamplighter
