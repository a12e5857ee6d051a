#include "editor/edits/history.h"

#include <gtest/gtest.h>

#include "editor/edits/edits.h"
#include "tests/support/scenes.h"

namespace lamplighter {
namespace {

struct Fixture {
  Document document;
  History history{document};
  NodeId parent, child, light;

  Fixture() {
    parent = test::addNode(document.scene, "parent");
    child = test::addNode(document.scene, "child", parent);
    light = test::addRectangleLight(document.scene, vec3(0, 2, 0), vec2(1.0f), vec3(5.0f));
    test::addMaterial(document.scene, vec3(0.5f));
  }
  Node edited(NodeId id, const vec3& at) const {
    Node n = *document.scene.find(id);
    n.local.translation = at;
    return n;
  }
  std::unique_ptr<Command> move(NodeId id, const vec3& at) const {
    return std::make_unique<EditNodes>("Move", document, std::vector<Node>{edited(id, at)});
  }
};

// Every command: done, undone and done again, the document is as it was.
class EveryCommand : public testing::TestWithParam<int> {};

TEST_P(EveryCommand, DoesUndoesAndRedoes) {
  Fixture f;
  const std::function<std::unique_ptr<Command>()> make[] = {
      [&] { return f.move(f.child, vec3(1, 2, 3)); },
      [&] {
        Node n = *f.document.scene.find(f.light);
        n.area->radiance = vec3(9.0f);
        n.name = "lamp";
        n.visible = false;
        return std::make_unique<EditNodes>("Light", f.document, std::vector<Node>{n});
      },
      [&] {
        Material m = f.document.scene.materials[0];
        m.baseColor.r = 0.9f;
        return std::make_unique<EditMaterial>(f.document, 0, m);
      },
      [&] {
        RenderSettings r = f.document.render;
        r.exposureEv = 2.0f;
        r.values.set("vpls", 99);
        return std::make_unique<EditRender>(f.document, r);
      },
      [&] { return std::make_unique<EditSky>(f.document, Sky(vec3(0.5f))); },
      [&] {
        return std::make_unique<AddNodes>("Add",
                                          copyNodes(f.document.scene, {f.parent, f.child}).nodes);
      },
      [&] { return std::make_unique<DeleteNodes>(f.document, std::vector<NodeId>{f.parent}); },
      [&] {
        return std::make_unique<DeleteNodes>(f.document, std::vector<NodeId>{f.child, f.light});
      },
  };
  std::unique_ptr<Command> command = make[GetParam()]();
  const uint64_t before = documentHash(f.document);
  f.history.run(std::move(command));
  const uint64_t after = documentHash(f.document);
  EXPECT_NE(before, after);
  f.history.undo();
  EXPECT_EQ(documentHash(f.document), before);
  f.history.redo();
  EXPECT_EQ(documentHash(f.document), after);
  f.history.undo();
  EXPECT_EQ(documentHash(f.document), before);
  EXPECT_FALSE(f.history.canUndo());
}
INSTANTIATE_TEST_SUITE_P(All, EveryCommand, testing::Range(0, 8));

TEST(History, ADragIsOneStep) {
  Fixture f;
  const uint64_t before = documentHash(f.document);
  f.history.begin("Move child");
  for (int i = 1; i <= 10; ++i) f.history.run(f.move(f.child, vec3(static_cast<float>(i))));
  f.history.commit();
  EXPECT_EQ(f.history.position(), 1u);
  EXPECT_EQ(f.history.undoLabel(), "Move child");
  f.history.undo();
  EXPECT_EQ(documentHash(f.document), before);
  f.history.redo();
  EXPECT_EQ(f.document.scene.find(f.child)->local.translation, vec3(10.0f));
}

TEST(History, ACancelledDragLeavesNothing) {
  Fixture f;
  const uint64_t before = documentHash(f.document);
  f.history.begin("Move");
  f.history.run(f.move(f.child, vec3(4.0f)));
  f.history.cancel();
  EXPECT_EQ(documentHash(f.document), before);
  EXPECT_FALSE(f.history.canUndo());
}

TEST(History, ADragBackToTheStartIsNoStep) {
  Fixture f;
  f.history.begin("Move");
  f.history.run(f.move(f.child, vec3(4.0f)));
  f.history.run(f.move(f.child, vec3(0.0f)));
  f.history.commit();
  EXPECT_FALSE(f.history.canUndo());
  f.history.run(f.move(f.child, vec3(0.0f)));
  EXPECT_FALSE(f.history.canUndo());
}

TEST(History, ANewStepForgetsWhatWasUndone) {
  Fixture f;
  f.history.run(f.move(f.child, vec3(1.0f)));
  f.history.undo();
  f.history.run(f.move(f.light, vec3(2.0f)));
  EXPECT_FALSE(f.history.canRedo());
}

TEST(History, UndoChangesExactlyWhatDoChanged) {
  Fixture f;
  EXPECT_TRUE(f.history.takeChanges().everything);
  EXPECT_TRUE(f.history.takeChanges().none());
  f.history.run(f.move(f.parent, vec3(1.0f)));
  const SceneChanges done = f.history.takeChanges();
  EXPECT_EQ(done.moved, (std::vector<NodeId>{f.parent, f.child}));
  f.history.undo();
  EXPECT_EQ(f.history.takeChanges().moved, done.moved);
  // Done and undone between two frames: nothing to refresh.
  f.history.redo();
  f.history.undo();
  EXPECT_TRUE(f.history.takeChanges().none());
}

TEST(CopyNodes, KeepsTheTreeAndGivesNewIds) {
  Fixture f;
  const Copies c = copyNodes(f.document.scene, {f.child, f.parent});
  ASSERT_EQ(c.nodes.size(), 2u);
  ASSERT_EQ(c.roots.size(), 1u);
  EXPECT_EQ(c.nodes[1].parent, c.nodes[0].id);
  EXPECT_EQ(f.document.scene.find(c.nodes[0].id), nullptr);
}

}  // namespace
}  // namespace lamplighter
