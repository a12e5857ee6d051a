#include "renderer/scene/scene_changes.h"

#include <gtest/gtest.h>

#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

using test::addMaterial;
using test::addMesh;
using test::addNode;
using test::addRectangleLight;

TEST(SceneChanges, TheSameSceneHasNone) {
  Scene scene;
  addMesh(scene, test::squareMesh(1.0f));
  EXPECT_TRUE(compare(scene, scene).none());
}

TEST(SceneChanges, AMovedParentMovesItsChildren) {
  Scene before;
  const NodeId parent = addNode(before, "parent");
  const NodeId child = addNode(before, "child", parent);
  addNode(before, "other");
  Scene after = before;
  after.find(parent)->local.translation.x = 1.0f;
  const SceneChanges c = compare(before, after);
  EXPECT_EQ(c.moved, (std::vector<NodeId>{parent, child}));
  EXPECT_FALSE(c.structure);
}

TEST(SceneChanges, NamesDoNotCount) {
  Scene before;
  addMaterial(before, vec3(0.5f));
  addNode(before, "a");
  Scene after = before;
  after.nodes[0].name = "b";
  after.materials[0].name = "m";
  EXPECT_TRUE(compare(before, after).none());
}

TEST(SceneChanges, KindsOfChangesAreDistinguished) {
  Scene before;
  addMaterial(before, vec3(0.5f));
  const NodeId light = addRectangleLight(before, vec3(0, 2, 0), vec2(1.0f), vec3(1.0f));

  Scene brighter = before;
  brighter.find(light)->area->radiance = vec3(2.0f);
  EXPECT_EQ(compare(before, brighter).lights, std::vector<NodeId>{light});
  EXPECT_TRUE(compare(before, brighter).moved.empty());

  Scene larger = before;
  larger.find(light)->area->size = vec2(2.0f);
  EXPECT_EQ(compare(before, larger).moved, std::vector<NodeId>{light});

  Scene painted = before;
  painted.materials[0].baseColor.r = 0.9f;
  EXPECT_EQ(compare(before, painted).materials, std::vector<int>{0});

  Scene hidden = before;
  hidden.nodes[0].visible = false;
  EXPECT_TRUE(compare(before, hidden).structure);

  Scene lit = before;
  lit.sky = vec3(1.0f);
  EXPECT_TRUE(compare(before, lit).sky);
}

}  // namespace
}  // namespace lamplighter
