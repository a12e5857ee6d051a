// Every kind of edit, done, undone, redone and rolled back.
#include "editor/edits/editing.h"

#include <gtest/gtest.h>

#include "editor/edits/clipboard_fragment.h"
#include "editor/edits/edits.h"
#include "editor/edits/tree.h"
#include "renderer/base/error.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

struct Fixture {
  Editing editing;
  NodeId parent, child, light;

  Fixture() {
    Document document;
    Scene& scene = document.scene;
    parent = test::addNode(scene, "parent");
    child = test::addNode(scene, "child", parent);
    light = test::addRectangleLight(scene, vec3(0, 2, 0), vec2(1.0f), vec3(5.0f));
    test::addMaterial(scene, vec3(0.5f));
    editing.open(std::move(document));
  }
  const Document& document() const { return editing.document(); }
  uint64_t hash() const { return documentHash(document()); }
  void move(NodeId id, const vec3& at) {
    Transaction edit = editing.begin("Move");
    edit.node(id).local.translation = at;
    edit.commit();
  }
};

using Edit = std::function<void(Fixture&, Transaction&)>;

ClipboardFragment texturedBox() {
  Scene other;
  const int red = test::addMaterial(other, vec3(0.6f, 0.1f, 0.1f));
  other.textures.push_back({"bricks", std::make_shared<Image8>(3, 2)});
  other.materials[static_cast<size_t>(red)].baseColorTexture.texture = 0;
  return clip(other, {test::addMesh(other, test::boxMesh(vec3(1.0f), red))});
}

const std::vector<Edit>& edits() {
  static const std::vector<Edit> kEdits = {
      [](Fixture& f, Transaction& t) { t.node(f.child).local.translation = vec3(1, 2, 3); },
      [](Fixture& f, Transaction& t) {
        Node n = *f.document().scene.find(f.light);
        n.area->radiance = vec3(9.0f);
        n.name = "lamp";
        n.visible = false;
        t.setNodes({n});
      },
      [](Fixture&, Transaction& t) { t.material(0).baseColor.r = 0.9f; },
      [](Fixture&, Transaction& t) {
        t.render().exposureEv = 2.0f;
        t.render().values.set("vpls", 99);
      },
      [](Fixture&, Transaction& t) { t.sky() = Sky(vec3(0.5f)); },
      [](Fixture&, Transaction& t) { t.skyLight().on = false; },
      [](Fixture&, Transaction& t) {
        t.lightGroups().push_back({"kitchen", true});
      },
      [](Fixture&, Transaction& t) {
        t.bookmarks().push_back({3, vec3(1.0f)});
      },
      [](Fixture& f, Transaction& t) {
        t.addNodes(copyNodes(f.editing, {f.parent, f.child}).nodes);
      },
      [](Fixture& f, Transaction& t) { t.removeNodes({f.parent}); },
      [](Fixture& f, Transaction& t) {
        t.removeNodes({f.child, f.light});
      },
      [](Fixture& f, Transaction&) { reparent(f.editing, {f.parent}, f.light); },
      [](Fixture& f, Transaction& t) { add(t, pasteInto(f.editing, texturedBox(), false)); },
      [](Fixture& f, Transaction& t) {  // several edits in one step
        t.removeNodes({f.child});
        t.node(f.parent).name = "group";
        add(t, pasteInto(f.editing, texturedBox(), false));
        reparent(f.editing, {f.light}, f.document().scene.nodes.back().id);
        t.node(f.light).area->size = vec2(3.0f);
        t.material(1).roughness = 0.1f;
      }};
  return kEdits;
}

class EveryEdit : public testing::TestWithParam<size_t> {
 protected:
  Fixture f_;
  Transaction make() {
    Transaction t = f_.editing.begin("Edit");
    edits()[GetParam()](f_, t);
    return t;
  }
};

TEST_P(EveryEdit, IsDoneUndoneAndRedone) {
  const uint64_t before = f_.hash();
  make().commit();
  const uint64_t after = f_.hash();
  EXPECT_NE(before, after);
  for (int i = 0; i < 2; ++i) {
    f_.editing.undo();
    EXPECT_EQ(f_.hash(), before);
    EXPECT_FALSE(f_.editing.canUndo());
    f_.editing.redo();
    EXPECT_EQ(f_.hash(), after);
    EXPECT_FALSE(f_.editing.canRedo());
  }
}

TEST_P(EveryEdit, IsRolledBackOnAnException) {
  const uint64_t before = f_.hash();
  const size_t meshes = f_.document().scene.meshes.size();
  const auto fails = [&] {
    const Transaction t = make();
    EXPECT_NE(f_.hash(), before);
    throw InputError("the edit", "fails", "nothing to do");
  };
  EXPECT_THROW(fails(), InputError);
  EXPECT_EQ(f_.hash(), before);
  EXPECT_EQ(f_.document().scene.meshes.size(), meshes);
  EXPECT_TRUE(f_.document().scene.textures.empty());
  EXPECT_FALSE(f_.editing.canUndo());
  EXPECT_FALSE(f_.editing.inTransaction());
}

TEST_P(EveryEdit, ReportsTheChangesThatAComparisonFinds) {
  f_.editing.takeChanges();
  const auto expectCompared = [&](const Scene& before, const char* what) {
    const SceneChanges taken = f_.editing.takeChanges();
    const SceneChanges compared = compare(before, f_.document().scene);
    EXPECT_EQ(taken.structure, compared.structure) << what;
    EXPECT_EQ(taken.sky, compared.sky) << what;
    EXPECT_EQ(taken.moved, compared.moved) << what;
    EXPECT_EQ(taken.lights, compared.lights) << what;
    EXPECT_EQ(taken.materials, compared.materials) << what;
  };
  const Scene before = f_.document().scene;
  Transaction edit = make();
  expectCompared(before, "in the transaction");
  edit.commit();
  EXPECT_TRUE(f_.editing.takeChanges().none());
  const Scene after = f_.document().scene;
  f_.editing.undo();
  expectCompared(after, "undo");
  f_.editing.redo();
  expectCompared(before, "redo");
}
INSTANTIATE_TEST_SUITE_P(All, EveryEdit, testing::Range(size_t{0}, edits().size()));

TEST(Editing, ADragIsOneStep) {
  Fixture f;
  const uint64_t before = f.hash();
  f.editing.hold("Move child");
  for (int i = 1; i <= 10; ++i) f.move(f.child, vec3(static_cast<float>(i)));
  f.editing.commit();
  EXPECT_EQ(f.editing.history().position(), 1u);
  EXPECT_EQ(f.editing.history().undoLabel(), "Move child");
  f.editing.undo();
  EXPECT_EQ(f.hash(), before);
  f.editing.redo();
  EXPECT_EQ(f.document().scene.find(f.child)->local.translation, vec3(10.0f));
}

TEST(Editing, ACancelledDragChangesNothing) {
  Fixture f;
  const uint64_t before = f.hash();
  f.editing.hold("Move");
  f.move(f.child, vec3(4.0f));
  f.editing.cancel();
  EXPECT_EQ(f.hash(), before);
  EXPECT_FALSE(f.editing.canUndo());
}

TEST(Editing, ADragBackToTheStartIsNotAStep) {
  Fixture f;
  f.editing.hold("Move");
  f.move(f.child, vec3(4.0f));
  f.move(f.child, vec3(0.0f));
  f.editing.commit();
  EXPECT_FALSE(f.editing.canUndo());
  f.move(f.child, vec3(0.0f));
  EXPECT_FALSE(f.editing.canUndo());
}

TEST(Editing, ANewStepClearsTheRedoSteps) {
  Fixture f;
  f.move(f.child, vec3(1.0f));
  f.editing.undo();
  f.move(f.light, vec3(2.0f));
  EXPECT_FALSE(f.editing.canRedo());
}

TEST(Editing, UndoReportsTheSameChangesAsTheEdit) {
  Fixture f;
  EXPECT_TRUE(f.editing.takeChanges().everything);
  EXPECT_TRUE(f.editing.takeChanges().none());
  f.move(f.parent, vec3(1.0f));
  const SceneChanges done = f.editing.takeChanges();
  EXPECT_EQ(done.moved, (std::vector<NodeId>{f.parent, f.child}));
  f.editing.undo();
  EXPECT_EQ(f.editing.takeChanges().moved, done.moved);
  // An edit that is undone before the next frame needs no update.
  f.editing.redo();
  f.editing.undo();
  EXPECT_TRUE(f.editing.takeChanges().none());
}

TEST(Editing, ANestedEditRollsBackOnItsOwn) {
  Fixture f;
  Transaction outer = f.editing.begin("");
  f.move(f.parent, vec3(1.0f));
  {
    Transaction inner = f.editing.begin("Fails");
    inner.node(f.parent).local.translation = vec3(5.0f);
    inner.node(f.child).name = "renamed";
  }
  EXPECT_EQ(f.document().scene.find(f.parent)->local.translation, vec3(1.0f));
  EXPECT_EQ(f.document().scene.find(f.child)->name, "child");
  outer.commit();
  EXPECT_EQ(f.editing.history().last(), 1u);
  EXPECT_EQ(f.editing.history().undoLabel(), "Move") << "the label of the first nested edit";
}

TEST(Editing, AnEndedTransactionDoesNothing) {
  Fixture f;
  Transaction edit = f.editing.begin("Move");
  edit.node(f.child).local.translation = vec3(1.0f);
  f.editing.undo();  // commits it first
  EXPECT_FALSE(edit.isOpen());
  f.move(f.light, vec3(2.0f));
  edit.cancel();
  EXPECT_EQ(f.document().scene.find(f.light)->local.translation, vec3(2.0f));
  EXPECT_EQ(f.editing.history().position(), 1u);
}

TEST(Editing, TheListenerGetsTheChangesSinceItsLastCall) {
  Fixture f;
  bool takes = false;
  Document copy = f.document();
  f.editing.setListener([&](const DocumentChange& change, const std::string&) {
    if (takes) change.apply(copy);
    return takes;
  });
  f.move(f.child, vec3(1.0f));
  RenderSettings render;
  render.exposureEv = 3.0f;
  f.editing.setInitialRender(render);
  f.editing.hold("Rolled back");
  f.move(f.light, vec3(7.0f));
  f.editing.cancel();
  EXPECT_NE(documentHash(copy), f.hash());
  takes = true;
  f.move(f.parent, vec3(2.0f));
  EXPECT_EQ(documentHash(copy), f.hash());
  f.editing.goTo(0);
  EXPECT_EQ(documentHash(copy), f.hash());
}

TEST(Editing, UndoDeselectsRemovedObjects) {
  Fixture f;
  const Copies copies = copyNodes(f.editing, {f.light});
  addNodes(f.editing, "Add", copies.nodes);
  f.editing.select({copies.roots[0], f.child, f.child, 999});
  EXPECT_EQ(f.document().selection, (std::vector<NodeId>{copies.roots[0], f.child}));
  f.editing.undo();
  EXPECT_EQ(f.document().selection, (std::vector<NodeId>{f.child}));
}

TEST(CopyNodes, KeepsTheTreeAndGivesNewIds) {
  Fixture f;
  const Copies c = copyNodes(f.editing, {f.child, f.parent});
  ASSERT_EQ(c.nodes.size(), 2u);
  ASSERT_EQ(c.roots.size(), 1u);
  EXPECT_EQ(c.nodes[1].parent, c.nodes[0].id);
  EXPECT_EQ(f.document().scene.find(c.nodes[0].id), nullptr);
}

}  // namespace
}  // namespace lamplighter
