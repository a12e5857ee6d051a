// Random edits: the changes reported to the renderer equal those that a comparison of the scenes
// finds.
#include <random>

#include <gtest/gtest.h>

#include "editor/edits/edits.h"
#include "editor/edits/tree.h"
#include "renderer/base/error.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

class RandomEditing : public testing::TestWithParam<uint32_t> {
 protected:
  Editing editing_;
  std::mt19937 random_{GetParam()};

  void SetUp() override {
    Document document;
    Scene& scene = document.scene;
    const int grey = test::addMaterial(scene, vec3(0.6f));
    const int glow = test::addMaterial(scene, vec3(0.1f), vec3(2.0f));
    for (int i = 0; i < 6; ++i) {
      const NodeId parent = test::addNode(scene, "group", i < 3 ? kNoNode : scene.nodes[0].id);
      const NodeId mesh = test::addMesh(scene, test::boxMesh(vec3(1.0f), i % 2 ? grey : glow));
      scene.find(mesh)->parent = parent;
      test::addRectangleLight(scene, vec3(0, 2, 0), vec2(1.0f), vec3(5.0f));
      scene.nodes.back().parent = parent;
    }
    editing_.open(std::move(document));
    editing_.takeChanges();
  }
  const Scene& scene() const { return editing_.document().scene; }
  size_t below(size_t count) { return random_() % count; }
  NodeId anyNode() { return scene().nodes[below(scene().nodes.size())].id; }
  vec3 anyVector() { return vec3(below(3), below(3), below(3)); }

  void edit() {
    if (scene().nodes.empty()) return editing_.undo();
    Transaction t = editing_.begin("Edit");
    const NodeId id = anyNode();
    switch (below(16)) {
      case 0:
      case 1:
        t.node(id).local.translation = anyVector();
        break;
      case 2:
        t.node(id).name = "renamed";
        break;
      case 3:
        t.node(id).visible = below(2) == 0;
        break;
      case 4:
        if (scene().find(id)->area) t.node(id).area->size = vec2(1.0f + anyVector().x);
        break;
      case 5:
        if (scene().find(id)->area) t.node(id).area->radiance = anyVector();
        break;
      case 6:
        t.node(id).light.on = below(3) > 0;
        break;
      case 7:
        t.node(id).light.solo = below(3) == 0;
        break;
      case 8:
        t.node(id).light.leftOut =
            below(2) == 0 ? std::vector<NodeId>{anyNode()} : std::vector<NodeId>{};
        break;
      case 9:
        t.material(static_cast<int>(below(2))).emissive = anyVector();
        break;
      case 10:
        t.material(static_cast<int>(below(2))).transmission = 0.5f * anyVector().x;
        break;
      case 11:
        t.sky() = Sky(anyVector());
        break;
      case 12:
        t.skyLight().solo = below(3) == 0;
        break;
      case 13:
        if (scene().nodes.size() > 10) t.removeNodes({id});
        break;
      case 14:
        if (scene().nodes.size() < 40) t.addNodes(copyNodes(editing_, {id}).nodes);
        break;
      default:
        reparent(editing_, {id}, anyNode());
    }
    if (below(5) > 0) t.commit();  // otherwise the destructor rolls it back
  }
  void step() {
    try {
      const size_t kind = below(8);
      if (kind == 0)
        editing_.undo();
      else if (kind == 1)
        editing_.redo();
      else
        edit();
    } catch (const InputError&) {
      // A node cannot be its own descendant: the edit is rolled back.
    }
  }
};

TEST_P(RandomEditing, ReportsTheChangesThatAComparisonFinds) {
  const uint64_t opened = documentHash(editing_.document());
  for (int frame = 0; frame < 100; ++frame) {
    const Scene before = scene();
    for (size_t i = 0, n = 1 + below(4); i < n; ++i) step();
    const SceneChanges taken = editing_.takeChanges(), compared = compare(before, scene());
    ASSERT_EQ(taken.everything, compared.everything) << frame;
    ASSERT_EQ(taken.structure, compared.structure) << frame;
    ASSERT_EQ(taken.sky, compared.sky) << frame;
    ASSERT_EQ(taken.moved, compared.moved) << frame;
    ASSERT_EQ(taken.lights, compared.lights) << frame;
    ASSERT_EQ(taken.materials, compared.materials) << frame;
  }
  editing_.goTo(0);
  EXPECT_EQ(documentHash(editing_.document()), opened);
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomEditing, testing::Range(1u, 9u));

}  // namespace
}  // namespace lamplighter
