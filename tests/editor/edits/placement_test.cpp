// Copy and paste, and placing objects on surfaces.
#include <cmath>

#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

using Clipboard = test::SessionFixture;

TEST_F(Clipboard, PastedNodesHaveTheSamePositionAndAreOneStep) {
  session_.select({box_, light_});
  const uint64_t before = hash();
  session_.perform("edit.copy");
  EXPECT_EQ(hash(), before);
  session_.perform("edit.paste");
  const auto& selection = session_.document().selection;
  ASSERT_EQ(selection.size(), 2u);
  EXPECT_EQ(session_.document().scene.nodes.size(), 5u);
  for (const NodeId id : selection) EXPECT_TRUE(id != box_ && id != light_);
  EXPECT_EQ(placeOf(selection[0]), placeOf(box_));
  EXPECT_TRUE(node(selection[1]).area);
  session_.undo();
  EXPECT_EQ(session_.document().scene.nodes.size(), 3u);
  session_.undo();  // there is no further step
  EXPECT_EQ(session_.document().scene.nodes.size(), 3u);
}

TEST_F(Clipboard, CutNodesAreRestoredByPasteOrUndo) {
  session_.select({box_});
  session_.perform("edit.cut");
  EXPECT_EQ(session_.document().scene.find(box_), nullptr);
  session_.perform("edit.paste");
  ASSERT_EQ(session_.document().selection.size(), 1u);
  EXPECT_EQ(placeOf(session_.document().active()), vec3(0, 0.5f, 0));
  session_.undo();
  session_.undo();
  EXPECT_NE(session_.document().scene.find(box_), nullptr);
}

// Descendants of a copied node are copied with it, once.
TEST_F(Clipboard, CopiesATreeOnce) {
  Scene scene = session_.document().scene;
  scene.find(light_)->parent = box_;
  scene.find(light_)->local.translation = vec3(0, 1, 0);
  open(std::move(scene));
  session_.select({box_, light_});
  session_.perform("edit.copy");
  session_.perform("edit.paste");
  ASSERT_EQ(session_.document().scene.nodes.size(), 5u);
  ASSERT_EQ(session_.document().selection.size(), 1u);
  const Node& child = session_.document().scene.nodes.back();
  EXPECT_EQ(child.parent, session_.document().active());
  EXPECT_EQ(placeOf(child.id), placeOf(light_));
}

// Pasting into another level copies the mesh and the material and keeps the position. Undo removes
// all of them.
TEST_F(Clipboard, PastesIntoAnotherLevel) {
  Scene scene = session_.document().scene;
  scene.find(floor_)->local.translation = vec3(0, -1, 0);
  scene.find(box_)->parent = floor_;
  open(std::move(scene));
  session_.select({box_, light_});
  const vec3 boxPlace = placeOf(box_), lightPlace = placeOf(light_);
  session_.perform("edit.copy");

  Scene other;
  const int red = test::addMaterial(other, vec3(0.6f, 0.1f, 0.1f));
  const NodeId ground = test::addMesh(other, test::squareMesh(4.0f, red));
  open(std::move(other));
  session_.renderFrame();
  const uint64_t before = hash();
  session_.perform("edit.paste");
  const Scene& now = session_.document().scene;
  ASSERT_EQ(now.nodes.size(), 3u);
  EXPECT_EQ(now.meshes.size(), 2u);
  EXPECT_EQ(now.materials.size(), 2u);
  ASSERT_EQ(session_.document().selection.size(), 2u);
  const Node& box = node(session_.document().selection[0]);
  EXPECT_EQ(box.parent, kNoNode);
  EXPECT_NE(box.id, ground);
  EXPECT_EQ(placeOf(box.id), boxPlace);
  EXPECT_EQ(placeOf(session_.document().selection[1]), lightPlace);
  const int material = now.meshes[static_cast<size_t>(box.mesh)]->primitives[0].material;
  EXPECT_EQ(now.materials[static_cast<size_t>(material)].baseColor, vec4(0.6f, 0.6f, 0.6f, 1.0f));
  session_.renderFrame();
  EXPECT_EQ(session_.renderError(), "");

  const uint64_t pasted = hash();
  session_.undo();
  EXPECT_EQ(hash(), before);
  EXPECT_EQ(session_.document().scene.meshes.size(), 1u);
  session_.renderFrame();
  session_.redo();
  EXPECT_EQ(hash(), pasted);
  // A second paste reuses the mesh and the material.
  session_.perform("edit.paste");
  EXPECT_EQ(session_.document().scene.materials.size(), 2u);
}

using Placing = test::SessionFixture;

// The active object is placed on the surface; the others keep their positions relative to it.
TEST_F(Placing, DroppingAGroupKeepsItTogetherAsOneStep) {
  session_.select({light_, box_});
  const vec3 offset = placeOf(light_) - placeOf(box_);
  input_.pointer = pixelOf(vec3(1.5f, 0, 1.0f));
  frame();
  session_.perform("object.drop");
  EXPECT_NEAR(placeOf(box_).x, 1.5f, 0.02f);
  EXPECT_NEAR(placeOf(box_).y, 0.5f, 1e-3f);  // the box stands on the floor
  EXPECT_NEAR(glm::length(placeOf(light_) - placeOf(box_) - offset), 0.0f, 1e-4f);
  session_.undo();
  EXPECT_EQ(placeOf(box_), vec3(0, 0.5f, 0));
  EXPECT_EQ(placeOf(light_), vec3(0, 4, 0));
}

TEST_F(Placing, ADragWithShiftFollowsTheSurfaces) {
  session_.select({box_});
  session_.perform("tool.move");
  Modifiers shift;
  shift.shift = true;
  pressXArrow(shift);
  dragTo(pixelOf(vec3(2.0f, 0, 1.0f)));
  release();
  EXPECT_NEAR(placeOf(box_).x, 2.0f, 0.02f);
  EXPECT_NEAR(placeOf(box_).y, 0.5f, 1e-3f);
  EXPECT_NEAR(placeOf(box_).z, 1.0f, 0.02f);
}

}  // namespace
}  // namespace lamplighter
