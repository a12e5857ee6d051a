// A drag of the gizmo that another action interrupts. It must end as a complete step or change
// nothing. It must not write into another step or another document.
#include "renderer/base/error.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

class InterruptedDrag : public test::SessionFixture {
 protected:
  void SetUp() override {
    SessionFixture::SetUp();
    session_.select({box_});
    session_.setTool(ToolMode::move);
    before_ = hash();
    pressXArrow();
    dragTo(input_.pointer + vec2(20, 0));
    ASSERT_GT(local(box_).translation.x, 0.1f);
  }
  uint64_t before_ = 0;
};

TEST_F(InterruptedDrag, UndoRevertsAndEndsTheDrag) {
  ASSERT_TRUE(session_.runAction("edit.undo"));
  EXPECT_EQ(hash(), before_);
  dragTo(input_.pointer + vec2(20, 0));
  dragTo(input_.pointer + vec2(20, 0));
  release();
  EXPECT_EQ(hash(), before_) << "the drag has ended, so further movement changes nothing";
  EXPECT_FALSE(session_.editing().canUndo());
}

TEST_F(InterruptedDrag, TheActionOfEscapeRevertsTheDragAndKeepsTheSelection) {
  // The key is pressed and released before the viewport reads it.
  ASSERT_TRUE(session_.runAction("select.none"));
  release();
  EXPECT_EQ(hash(), before_);
  EXPECT_EQ(session_.document().selection, std::vector<NodeId>{box_});
  ASSERT_TRUE(session_.runAction("select.none"));
  EXPECT_TRUE(session_.document().selection.empty());
}

TEST_F(InterruptedDrag, AnotherEditIsASeparateStep) {
  const float x = local(box_).translation.x;
  ASSERT_TRUE(session_.runAction("edit.duplicate"));
  dragTo(input_.pointer + vec2(20, 0));
  release();
  EXPECT_EQ(session_.history().position(), 2u);
  EXPECT_EQ(local(box_).translation.x, x);
  session_.undo();
  EXPECT_EQ(session_.document().scene.nodes.size(), 3u);
  EXPECT_EQ(local(box_).translation.x, x);
  session_.undo();
  EXPECT_EQ(hash(), before_);
}

TEST_F(InterruptedDrag, DeletingTheDraggedObjectLeavesTwoSteps) {
  ASSERT_TRUE(session_.runAction("edit.delete"));
  dragTo(input_.pointer + vec2(20, 0));
  release();
  EXPECT_EQ(session_.history().position(), 2u);
  session_.undo();
  session_.undo();
  EXPECT_EQ(hash(), before_);
}

TEST_F(InterruptedDrag, OpeningAnotherLevelEndsTheDrag) {
  Scene other;
  test::addMesh(other, test::squareMesh(4.0f));
  test::addMesh(other, test::boxMesh(vec3(1.0f)),
                vec3(0, 0.5f, 0));  // has the id of the dragged object
  ASSERT_NE(other.find(box_), nullptr);
  session_.open(std::move(other), "other.gltf", {});
  const uint64_t opened = hash();
  dragTo(input_.pointer + vec2(20, 0));
  release();
  EXPECT_EQ(hash(), opened);
  EXPECT_FALSE(session_.editing().canUndo());
}

TEST_F(InterruptedDrag, SwitchingSnapDoesNotEndIt) {
  ASSERT_TRUE(session_.runAction("tool.snap"));
  dragTo(input_.pointer + vec2(1, 0));
  const float x = local(box_).translation.x;
  EXPECT_EQ(x, 0.25f * std::round(x / 0.25f));
  release();
  EXPECT_EQ(session_.history().position(), 1u);
}

}  // namespace
}  // namespace lamplighter
