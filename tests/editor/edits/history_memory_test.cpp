// The memory budget of the history, and jumps to any step.
#include "editor/edits/edits.h"
#include "renderer/base/error.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter::test {

namespace {

class HistorySteps : public SessionFixture {
 protected:
  void move(float x) {
    Transform t = local(box_);
    t.translation.x = x;
    session_.setNodeTransform(box_, t);
  }
  const History& history() const { return session_.history(); }
};

TEST_F(HistorySteps, GoesToAnyStepAndBack) {
  std::vector<uint64_t> hashes{hash()};
  for (int i = 1; i <= 6; ++i) {
    move(static_cast<float>(i));
    hashes.push_back(hash());
  }
  for (const size_t step : {3u, 0u, 6u, 1u, 1u, 5u}) {
    ASSERT_TRUE(session_.runAction("history.go " + std::to_string(step)));
    EXPECT_EQ(hash(), hashes[step]);
    EXPECT_EQ(history().position(), step);
  }
  EXPECT_FALSE(session_.runAction("history.go 7"));
  EXPECT_FALSE(session_.runAction("history.go -1"));
  EXPECT_FALSE(session_.runAction("history.go 1.5"));
  EXPECT_EQ(history().position(), 5u);
  EXPECT_EQ(history().label(6), "Transform box");
}

TEST_F(HistorySteps, BulkEditsAndDragsAreOneStep) {
  session_.runAction("light.add sphere");
  session_.runAction("light.add disk");
  const size_t before = history().position();
  session_.runAction("lights.select");
  session_.runAction("lights.darker");
  EXPECT_EQ(history().position(), before + 1);
  session_.select({box_});
  session_.runAction("tool.move");
  pressXArrow();
  for (int i = 1; i < 9; ++i) dragTo(input_.pointer + vec2(5, 0));
  release();
  EXPECT_EQ(history().position(), before + 2);
}

TEST_F(HistorySteps, ForgetsTheOldestBeyondTheBudget) {
  move(1.0f);
  const size_t one = history().bytes();
  ASSERT_GT(one, sizeof(Node));
  session_.editing().setBudget(10 * one);
  for (int i = 2; i <= 50; ++i) move(static_cast<float>(i));
  EXPECT_LE(history().bytes(), 10 * one);
  EXPECT_EQ(history().position(), 50u);
  EXPECT_EQ(history().first(), 40u);
  EXPECT_EQ(history().last(), 50u);
  EXPECT_THROW(session_.goToStep(39), InputError);
  session_.goToStep(40);
  EXPECT_EQ(local(box_).translation.x, 40.0f);
  EXPECT_FALSE(session_.editing().canUndo());
  session_.goToStep(50);
  EXPECT_EQ(local(box_).translation.x, 50.0f);
}

TEST_F(HistorySteps, TheNewestStepIsAlwaysKept) {
  session_.editing().setBudget(1);
  move(1.0f);
  move(2.0f);
  EXPECT_EQ(history().first(), 1u);
  session_.undo();
  EXPECT_EQ(local(box_).translation.x, 1.0f);
  session_.redo();
  EXPECT_EQ(local(box_).translation.x, 2.0f);
}

TEST_F(HistorySteps, DroppedRedoStepsFreeTheirMemory) {
  move(1.0f);
  const size_t one = history().bytes();
  for (int i = 2; i <= 9; ++i) move(static_cast<float>(i));
  session_.goToStep(0);
  move(3.5f);
  EXPECT_EQ(history().bytes(), one);
  EXPECT_EQ(history().last(), 1u);
  session_.editing().open(session_.document());
  EXPECT_EQ(history().bytes(), 0u);
}

TEST_F(HistorySteps, TheBudgetHasAUnitAndARange) {
  EXPECT_EQ(history().budget(), size_t{256} << 20);
  EXPECT_TRUE(session_.runAction("history.memory 16"));
  EXPECT_EQ(history().budget(), size_t{16} << 20);
  EXPECT_FALSE(session_.runAction("history.memory 0"));
  EXPECT_FALSE(session_.runAction("history.memory much"));
  EXPECT_EQ(history().budget(), size_t{16} << 20);
}

TEST_F(HistorySteps, UndoRestoresThePictureBitForBit) {
  const auto settled = [&] {
    for (int i = 0; i < 2000; ++i)
      if (session_.renderFrame().settled) return session_.output().radiance->pixels().pixels;
    ADD_FAILURE() << "the picture does not settle";
    return std::vector<vec3>();
  };
  session_.runAction("render.set vpls=64");
  session_.runAction("render.set bounces=2");
  session_.runAction("render.set seed=3");
  const std::vector<vec3> before = settled();
  const char* const kEdits[] = {"select.name box|object.move 0.5 0.5 0.25",
                                "select.name box|edit.delete",
                                "light.add sphere",
                                "lights.select|lights.brighter",
                                "lights.select|lights.on false",
                                "render.set vpls=32",
                                "select.name floor|object.hide"};
  for (const std::string edits : kEdits) {
    SCOPED_TRACE(edits);
    const size_t step = history().position();
    for (size_t at = 0; at != std::string::npos;) {
      const size_t end = edits.find('|', at);
      session_.runAction(edits.substr(at, end == std::string::npos ? end : end - at));
      at = end == std::string::npos ? end : end + 1;
    }
    const std::vector<vec3> edited = settled();
    EXPECT_FALSE(edited == before);
    session_.goToStep(step);
    const std::vector<vec3> after = settled();
    ASSERT_EQ(after.size(), before.size());
    EXPECT_TRUE(std::equal(after.begin(), after.end(), before.begin()));
  }
}

}  // namespace

}  // namespace lamplighter::test
