// Placing by click, rows and grids of copies, aligning, and snapping.
#include <cmath>

#include "renderer/base/error.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

using PlacingTools = test::SessionFixture;

TEST_F(PlacingTools, AClickPlacesALightOnTheSurfaceFacingOutwards) {
  const uint64_t before = hash();
  session_.perform("place.start light.add disk");
  EXPECT_EQ(hash(), before);
  press(pixelOf(vec3(2.0f, 0, 0)));
  release();
  ASSERT_EQ(session_.document().scene.nodes.size(), 4u);
  const Node& added = session_.document().scene.nodes.back();
  ASSERT_TRUE(added.area);
  EXPECT_NEAR(placeOf(added.id).x, 2.0f, 0.03f);
  EXPECT_NEAR(placeOf(added.id).y, 0.01f, 1e-3f);
  EXPECT_NEAR((added.local.rotation * vec3(0, 0, -1)).y, 1.0f, 1e-4f);
  EXPECT_EQ(session_.document().active(), added.id);
  // It is one undo step, and the next click selects again.
  const uint64_t placed = hash();
  press(pixelOf(vec3(0, 0.5f, 0.5f)));
  release();
  EXPECT_EQ(session_.document().active(), box_);
  session_.undo();
  EXPECT_EQ(hash(), before);
  session_.redo();
  EXPECT_EQ(hash(), placed);
}

TEST_F(PlacingTools, CopiedObjectsArePlacedInOneStep) {
  session_.select({box_});
  session_.perform("edit.copy");
  const uint64_t before = hash();
  session_.perform("place.start edit.paste");
  press(pixelOf(vec3(2.0f, 0, 0)));
  release();
  ASSERT_EQ(session_.document().scene.nodes.size(), 4u);
  EXPECT_NEAR(placeOf(session_.document().active()).x, 2.0f, 0.03f);
  EXPECT_NEAR(placeOf(session_.document().active()).y, 0.5f, 1e-3f);
  session_.undo();
  EXPECT_EQ(hash(), before);
}

TEST_F(PlacingTools, WithShiftPlacingContinues) {
  session_.perform("place.start light.add rectangle");
  Modifiers shift;
  shift.shift = true;
  press(pixelOf(vec3(2.0f, 0, 0)), 0, shift);
  release();
  press(pixelOf(vec3(-2.0f, 0, 0)));
  release();
  EXPECT_EQ(session_.document().scene.nodes.size(), 5u);
  EXPECT_FALSE(session_.placing());
}

TEST_F(PlacingTools, EscapeCancelsPlacing) {
  session_.perform("place.start light.add rectangle");
  session_.perform("select.none");
  EXPECT_FALSE(session_.placing());
  EXPECT_THROW(session_.perform("place.start no.such"), InputError);
}

TEST_F(PlacingTools, ARowOfCopiesIsEvenlySpacedAndOneStep) {
  session_.select({box_});
  const uint64_t before = hash();
  session_.perform("edit.duplicate_line 3 1.5 0 -0.5");
  ASSERT_EQ(session_.document().scene.nodes.size(), 6u);
  for (size_t i = 0; i < 3; ++i) {
    const vec3 expected = placeOf(box_) + static_cast<float>(i + 1) * vec3(1.5f, 0, -0.5f);
    EXPECT_LT(glm::length(placeOf(session_.document().scene.nodes[3 + i].id) - expected), 1e-5f);
  }
  EXPECT_EQ(session_.document().selection.size(), 4u);
  session_.undo();
  EXPECT_EQ(hash(), before);
}

TEST_F(PlacingTools, AGridFillsItsCells) {
  session_.select({light_});
  session_.perform("edit.duplicate_grid 3 2 2 1 2 4");
  ASSERT_EQ(session_.document().scene.nodes.size(), 3u + 11u);
  vec3 farthest(0.0f);
  for (const Node& n : session_.document().scene.nodes)
    if (n.area) farthest = glm::max(farthest, placeOf(n.id) - placeOf(light_));
  EXPECT_LT(glm::length(farthest - vec3(2, 2, 4)), 1e-5f);
  EXPECT_THROW(session_.perform("edit.duplicate_grid 100 100 2 1 1 1"), InputError);
  // The limit counts all objects of the level, not only the copies of one action.
  const size_t nodes = session_.document().scene.nodes.size();
  session_.select({light_});
  session_.perform("edit.duplicate_line 9000 1 0 0");
  const size_t many = session_.document().scene.nodes.size();
  EXPECT_THROW(session_.perform("edit.duplicate_line 2 0 0 1"), InputError);
  EXPECT_EQ(session_.document().scene.nodes.size(), many);
  session_.undo();
  EXPECT_EQ(session_.document().scene.nodes.size(), nodes);
  EXPECT_THROW(session_.perform("edit.duplicate_line 0 1 1 1"), InputError);
}

TEST_F(PlacingTools, AlignTurnsAnObjectUprightOnTheSurface) {
  Node tilted = node(box_);
  tilted.local.rotation = glm::angleAxis(0.7f, glm::normalize(vec3(1, 0.2f, 0.4f)));
  session_.setNodeTransform(box_, tilted.local);
  session_.renderFrame();
  session_.select({box_});
  input_.pointer = pixelOf(vec3(2.0f, 0, 0));
  frame();
  session_.perform("object.align");
  EXPECT_NEAR((local(box_).rotation * vec3(0, 1, 0)).y, 1.0f, 1e-5f);
  EXPECT_EQ(local(box_).translation, tilted.local.translation);
}

// The light moves exactly to the corner of the box that is nearest to the pointer.
TEST_F(PlacingTools, AMoveSnapsToVertices) {
  session_.select({light_});
  session_.perform("tool.move");
  session_.perform("tool.snap_vertex");
  session_.perform("tool.snap");
  pressXArrow();
  dragTo(pixelOf(vec3(0.45f, 0.97f, 0.5f)));
  release();
  EXPECT_LT(glm::length(placeOf(light_) - vec3(0.5f, 1.0f, 0.5f)), 1e-5f);
}

}  // namespace
}  // namespace lamplighter
