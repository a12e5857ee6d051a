// The tree of objects and edits of several objects: world positions stay, locks hold, and each edit
// is one step.
#include "editor/edits/tree.h"

#include <gmock/gmock.h>

#include "editor/edits/object_edits.h"
#include "editor/lights/light_table_edits.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/editor/session_fixture.h"
#include "tests/support/scenes/gltf_files.h"

namespace lamplighter {
namespace {

using testing::ElementsAre;

class Tree : public test::SessionFixture {
 protected:
  NodeId group_ = 0, inner_ = 0, bulb_ = 0;
  void addMore(Scene& scene) override {
    group_ = test::addNode(scene, "group", kNoNode, vec3(1, 2, 3));
    scene.find(group_)->local.rotation = glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, 3)));
    scene.find(group_)->local.scale = vec3(2, 1, 0.5f);
    inner_ = test::addNode(scene, "inner", group_, vec3(0, 1, 0));
    bulb_ = test::addNode(scene, "bulb", kNoNode, vec3(1, 2, 0));
    scene.find(bulb_)->punctual = PunctualLight{PunctualKind::point, vec3(5.0f)};
    scene.find(light_)->name = "lamp";
  }
  const Scene& scene() const { return session_.document().scene; }
  void expectParentsFirst() const {
    std::vector<NodeId> seen{kNoNode};
    for (const Node& n : scene().nodes) {
      EXPECT_THAT(seen, testing::Contains(n.parent)) << n.name;
      seen.push_back(n.id);
    }
  }
};

TEST_F(Tree, ReparentingKeepsTheWorldPosition) {
  const mat4 box = worldMatrix(scene(), box_), floor = worldMatrix(scene(), floor_);
  session_.select({floor_, box_});
  expectOneStep("object.reparent inner");  // which is after them in the list
  EXPECT_EQ(node(box_).parent, inner_);
  expectParentsFirst();
  const auto near = [](const mat4& a, const mat4& b) {
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r) EXPECT_NEAR(a[c][r], b[c][r], 1e-5f);
  };
  near(worldMatrix(scene(), box_), box);
  near(worldMatrix(scene(), floor_), floor);
  session_.select({box_});
  expectOneStep("object.reparent none");
  EXPECT_EQ(node(box_).parent, kNoNode);
  near(worldMatrix(scene(), box_), box);
  expectParentsFirst();
}

TEST_F(Tree, AnInvalidParentIsRefused) {
  const uint64_t before = hash();
  session_.select({group_});
  EXPECT_FALSE(session_.runAction("object.reparent inner"));
  EXPECT_FALSE(session_.runAction("object.reparent group"));
  EXPECT_FALSE(session_.runAction("object.reparent nobody"));
  EXPECT_EQ(hash(), before);
  // The current parent changes nothing.
  session_.select({inner_});
  EXPECT_TRUE(session_.runAction("object.reparent group"));
  EXPECT_EQ(hash(), before);
  EXPECT_FALSE(session_.editing().canUndo());
}

TEST_F(Tree, ThePictureFollows) {
  session_.select({box_});
  ASSERT_TRUE(session_.runAction("object.reparent group"));
  while (!session_.renderFrame().settled) {
  }
  const Image live = session_.output().radiance->pixels();
  Session fresh(std::make_unique<FrameRenderer>(makeCpuBackend()));
  fresh.resizeViewport(320, 200);
  fresh.open(scene(), "again.gltf", {});
  fresh.setView(session_.view());
  fresh.editing().setInitialRender(session_.document().render);
  while (!fresh.renderFrame().settled) {
  }
  EXPECT_EQ(live.pixels, fresh.output().radiance->pixels().pixels);
}

TEST_F(Tree, LockedObjectsAreNeitherPickedNorMoved) {
  const vec2 onBox = pixelOf(vec3(0, 0.5f, 0.5f));
  session_.select({box_});
  expectOneStep("object.lock");
  EXPECT_TRUE(isLocked(scene(), box_));
  session_.select({});
  press(onBox);
  release();
  EXPECT_THAT(session_.document().selection, ElementsAre(floor_));  // the object behind it
  // If selected in the list, it has no handles and cannot be dropped.
  session_.select({box_});
  session_.setTool(ToolMode::move);
  const vec3 place = placeOf(box_);
  pressXArrow();
  EXPECT_FALSE(session_.dragging());
  release();
  session_.select({box_});
  EXPECT_FALSE(session_.runAction("object.drop"));
  // In a selection with other objects it does not move.
  session_.select({box_, bulb_});
  pressXArrow();
  EXPECT_TRUE(session_.dragging());
  dragTo(pixelOf(placeOf(bulb_)) + vec2(150, 0));
  release();
  EXPECT_EQ(placeOf(box_), place);
  EXPECT_NE(placeOf(bulb_), vec3(1, 2, 0));
  expectOneStep("object.unlock_all");
  EXPECT_FALSE(isLocked(scene(), box_));
}

TEST_F(Tree, LocksApplyToDescendantsAndAreSaved) {
  session_.select({group_});
  ASSERT_TRUE(session_.runAction("object.lock"));
  EXPECT_TRUE(isLocked(scene(), inner_));
  EXPECT_FALSE(node(inner_).locked);
  const test::TemporaryFolder folder;
  saveGltf(scene(), folder.path() / "s.gltf");
  const Scene loaded = loadGltf(folder.path() / "s.gltf").scene;
  int locked = 0;
  for (const Node& n : loaded.nodes) {
    locked += n.locked;
    EXPECT_EQ(n.locked, n.name == "group");
  }
  EXPECT_EQ(locked, 1);
}

TEST_F(Tree, NumbersOfSeveralObjectsAreSetTogether) {
  session_.select({box_, bulb_, group_});
  const ObjectProperty& y = objectProperty("position.y");
  EXPECT_FALSE(commonNumber(session_.document(), y));
  expectOneStep("objects.set position.y 1.5");
  EXPECT_EQ(commonNumber(session_.document(), y), 1.5f);
  EXPECT_EQ(local(box_).translation.x, 0.0f);
  EXPECT_EQ(local(group_).translation.z, 3.0f);
  expectOneStep("objects.set rotation.z 30");
  EXPECT_NEAR(*commonNumber(session_.document(), objectProperty("rotation.z")), 30.0f, 1e-3f);
  expectOneStep("objects.set scale.x 3");
  const uint64_t before = hash();
  EXPECT_FALSE(session_.runAction("objects.set colour 3"));
  EXPECT_FALSE(session_.runAction("objects.set position.x far"));
  EXPECT_EQ(hash(), before);
}

TEST_F(Tree, MaterialsAndKindsOfSeveralObjectsAreSetTogether) {
  session_.select({box_, floor_, bulb_});
  EXPECT_EQ(selectedMaterials(session_.document()).size(), 1u);
  expectOneStep("materials.roughness 0.3");
  expectOneStep("materials.metallic 0.5");
  expectOneStep("materials.colour 0.2 0.4 0.6");
  EXPECT_EQ(scene().materials[0].roughness, 0.3f);
  EXPECT_EQ(vec3(scene().materials[0].baseColor), vec3(0.2f, 0.4f, 0.6f));
  expectOneStep("objects.lit_as complex");
  EXPECT_EQ(node(box_).meshKind, MeshKind::complex);
  EXPECT_EQ(node(bulb_).meshKind, MeshKind::automatic);
  const uint64_t before = hash();
  EXPECT_FALSE(session_.runAction("materials.roughness 2"));
  EXPECT_FALSE(session_.runAction("objects.lit_as nicely"));
  session_.select({bulb_});
  EXPECT_FALSE(session_.runAction("materials.roughness 0.5"));
  EXPECT_EQ(hash(), before);
}

TEST_F(Tree, CellsOfTheLightTableAreEdited) {
  session_.select({bulb_, light_});
  expectOneStep("lights.edit strength \"700 lm\"");
  expectOneStep("lights.edit strength 1,200");
  expectOneStep("lights.edit temperature \"2,700 K\"");
  expectOneStep("lights.edit group kitchen");
  EXPECT_EQ(node(bulb_).light.group, "kitchen");
  expectOneStep("lights.edit name shelf");
  EXPECT_EQ(node(light_).name, "shelf");  // in the order of the table
  EXPECT_EQ(node(bulb_).name, "shelf 2");
  session_.select({light_});
  expectOneStep("lights.edit size \"1.2 \u00d7 0.6\"");
  EXPECT_EQ(node(light_).area->size, vec2(1.2f, 0.6f));
  expectOneStep("lights.edit size 0.5");
  EXPECT_EQ(node(light_).area->size, vec2(0.5f));
  const uint64_t before = hash();
  for (const char* bad :
       {"lights.edit strength bright", "lights.edit strength \"5 miles\"",
        "lights.edit size \"1 x wide\"", "lights.edit name \"\"", "lights.edit samples 5"})
    EXPECT_FALSE(session_.runAction(bad)) << bad;
  session_.select({bulb_});
  EXPECT_FALSE(session_.runAction("lights.edit size 2"));  // this light has no size
  EXPECT_EQ(hash(), before);
}

}  // namespace
}  // namespace lamplighter
