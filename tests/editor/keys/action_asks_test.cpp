// The questions that actions declare for the user, and that scripts need no answer.
#include "renderer/base/error.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

using Kind = ActionAsk::Kind;

class ActionAsks : public test::SessionFixture {
 protected:
  const Action& action(const std::string& name) const { return *session_.actions().find(name); }
};

TEST_F(ActionAsks, EachHasATitleAndFileTypes) {
  size_t count = 0;
  for (const auto& [name, action] : session_.actions().all()) {
    SCOPED_TRACE(name);
    if (!action.asks) continue;
    ++count;
    const ActionAsk& asks = *action.asks;
    EXPECT_FALSE(asks.title.empty());
    const bool isFile = asks.kind == Kind::openFile || asks.kind == Kind::saveFile;
    EXPECT_EQ(asks.extensions.empty(), !isFile);
    for (const std::string_view extension : asks.extensions)
      EXPECT_TRUE(hasExtension("x" + std::string(extension), asks.extensions)) << extension;
    // A name to save under, or a name to type, must be suggested.
    EXPECT_TRUE(asks.kind == Kind::openFile || asks.suggested);
    const Action* answered =
        asks.answeredBy.empty() ? &action : session_.actions().find(asks.answeredBy);
    ASSERT_NE(answered, nullptr);
    EXPECT_TRUE(answered->needsArguments());
  }
  EXPECT_GE(count, 12u);
}

TEST_F(ActionAsks, ActionsWithAFileOrFolderAsk) {
  for (const auto& [name, action] : session_.actions().all())
    if (action.usage.starts_with("FILE") || action.usage.starts_with("FOLDER")) {
      EXPECT_TRUE(action.asks) << name;
    }
}

TEST_F(ActionAsks, SavingAsksOnlyWhileTheLevelHasNoFile) {
  EXPECT_FALSE(action("file.save").asksIn(session_));
  EXPECT_TRUE(action("file.save_as").asksIn(session_));
  EXPECT_EQ(action("file.save_as").asks->suggested(session_), "test.gltf");
  session_.open(Scene(), {}, {});
  EXPECT_TRUE(action("file.save").asksIn(session_));
  EXPECT_EQ(action("file.save").asks->suggested(session_), "untitled.gltf");
}

TEST_F(ActionAsks, RenameSuggestsTheNameOfTheActiveObject) {
  const ActionAsk& asks = *action("edit.rename").asks;
  session_.select({box_});
  EXPECT_EQ(asks.suggested(session_), "box");
  session_.select({});
  EXPECT_THROW(asks.suggested(session_), InputError);
}

// A script cannot ask the user.
TEST_F(ActionAsks, WithoutAWindowAnArgumentIsRequired) {
  const uint64_t before = hash();
  for (const char* name : {"file.open", "file.save_as", "sky.image", "edit.rename"})
    EXPECT_THROW(session_.perform(name), InputError) << name;
  EXPECT_EQ(hash(), before);
}

TEST_F(ActionAsks, TheUsageSaysHowManyArgumentsFit) {
  const auto fitting = [](const char* usage) {
    std::string counts;
    for (size_t n = 0; n < 6; ++n)
      if (Action{.usage = usage}.takes(n)) counts += std::to_string(n);
    return counts;
  };
  EXPECT_EQ(fitting(""), "0");
  EXPECT_EQ(fitting("X Y Z"), "3");
  EXPECT_EQ(fitting("rectangle|disk"), "1");
  EXPECT_EQ(fitting("1…9"), "1");
  EXPECT_EQ(fitting("FILE [force]"), "12");
  EXPECT_EQ(fitting("[LOW HIGH]"), "02");
  EXPECT_EQ(fitting("NAME [NAME]…"), "12345");
}

TEST_F(ActionAsks, ADisabledActionDoesNotAsk) {
  Action disabled{.name = "test.disabled", .asks = ActionAsk{.kind = Kind::name, .title = "Name"}};
  EXPECT_TRUE(disabled.asksIn(session_));
  disabled.enabled = [](const Session&) { return false; };
  EXPECT_FALSE(disabled.asksIn(session_));
}

}  // namespace
}  // namespace lamplighter
