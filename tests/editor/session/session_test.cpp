// The session as used by the ui: input of pointer and keys, output of document and picture.
#include "editor/session/session.h"

#include <cmath>

#include <gtest/gtest.h>

#include "editor/tools/projection.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

class SessionTest : public testing::Test {
 protected:
  Session session_{std::make_unique<FrameRenderer>(makeCpuBackend())};
  NodeId floor_ = 0, box_ = 0, light_ = 0;

  void SetUp() override {
    Scene scene;
    const int grey = test::addMaterial(scene, vec3(0.6f));
    floor_ = test::addMesh(scene, test::squareMesh(10.0f, grey));
    box_ = test::addMesh(scene, test::boxMesh(vec3(1.0f), grey), vec3(0, 0.5f, 0));
    scene.find(floor_)->name = "floor";
    scene.find(box_)->name = "box";
    light_ = test::addRectangleLight(scene, vec3(0, 4, 0), vec2(1.0f), vec3(10.0f));
    session_.resizeViewport(320, 200);
    session_.open(std::move(scene), "test.gltf", {});
    View view = session_.view();
    view.eye = vec3(0, 2, 6);
    view.orientation = glm::angleAxis(-0.25f, vec3(1, 0, 0));
    session_.setView(view);
    RenderSettings r = session_.document().render;
    r.values.set("vpls", 16);
    r.values.set("map_resolution", 16);
    session_.editing().setInitialRender(r);
    session_.renderFrame();
  }

  vec2 pixelOf(const vec3& world) const { return vec2(session_.view().project(world)); }

  ViewportInput at(const vec2& pointer) const {
    ViewportInput in;
    in.pointer = pointer;
    in.hovered = true;
    return in;
  }
  void click(const vec2& pointer, Modifiers modifiers = {}) {
    ViewportInput in = at(pointer);
    in.modifiers = modifiers;
    session_.viewport(in);
    in.pressed[0] = in.down[0] = true;
    session_.viewport(in);
    in.pressed[0] = in.down[0] = false;
    in.released[0] = true;
    session_.viewport(in);
  }
  // Presses `button` at the first point and releases it at the last.
  void drag(const std::vector<vec2>& way, int button = 0, Modifiers modifiers = {},
            std::set<Key> keysAtEnd = {}) {
    ViewportInput in = at(way.front());
    in.modifiers = modifiers;
    session_.viewport(in);  // moves the pointer without a button
    in.pressed[button] = in.down[button] = true;
    session_.viewport(in);
    in.pressed[button] = false;
    for (size_t i = 1; i < way.size(); ++i) {
      in.pointer = way[i];
      if (i + 1 == way.size()) in.keys = keysAtEnd;
      session_.viewport(in);
    }
    in.down[button] = false;
    in.released[button] = true;
    session_.viewport(in);
  }
  const Transform& local(NodeId id) const { return session_.document().scene.find(id)->local; }
};

TEST_F(SessionTest, AClickSelectsTheVisibleObject) {
  click(pixelOf(vec3(0, 0.9f, 0.5f)));
  EXPECT_EQ(session_.document().selection, std::vector<NodeId>{box_});
  click(pixelOf(vec3(3, 0, 1)), {.shift = true});
  EXPECT_EQ(session_.document().selection, (std::vector<NodeId>{box_, floor_}));
  click(pixelOf(vec3(0, 0.9f, 0.5f)), {.ctrl = true});
  EXPECT_EQ(session_.document().selection, std::vector<NodeId>{floor_});
  click(vec2(2, 2));  // outside of all objects
  EXPECT_TRUE(session_.document().selection.empty());
  EXPECT_FALSE(session_.editing().canUndo()) << "a selection is not an edit";
}

TEST_F(SessionTest, APunctualLightIsPickedByItsIcon) {
  Document document = session_.document();
  const NodeId id = test::addNode(document.scene, "lamp", kNoNode, vec3(2, 1.5f, 1));
  document.scene.find(id)->punctual = PunctualLight{};
  session_.editing().open(std::move(document));
  session_.renderFrame();
  click(pixelOf(vec3(2, 1.5f, 1)) + vec2(5, 0));
  EXPECT_EQ(session_.document().active(), id);
}

TEST_F(SessionTest, DraggingAnArrowMovesAlongItsAxisAsOneStep) {
  session_.select({box_});
  session_.setTool(ToolMode::move);
  const float reach = 60.0f * metresPerPixel(session_.view(), vec3(0, 0.5f, 0));
  const vec2 grip = pixelOf(vec3(reach, 0.5f, 0)), to = pixelOf(vec3(reach + 1.0f, 0.5f, 0));
  drag({grip, 0.5f * (grip + to), to});
  EXPECT_NEAR(local(box_).translation.x, 1.0f, 0.02f);
  EXPECT_EQ(local(box_).translation.y, 0.5f);
  EXPECT_EQ(local(box_).translation.z, 0.0f);
  EXPECT_EQ(session_.history().position(), 1u);
  EXPECT_EQ(session_.history().undoLabel(), "Move box");
  session_.undo();
  EXPECT_EQ(local(box_).translation, vec3(0, 0.5f, 0));
}

TEST_F(SessionTest, CtrlSnapsToTheGrid) {
  session_.select({box_});
  session_.setTool(ToolMode::move);
  const float reach = 60.0f * metresPerPixel(session_.view(), vec3(0, 0.5f, 0));
  drag({pixelOf(vec3(reach, 0.5f, 0)), pixelOf(vec3(reach + 0.83f, 0.5f, 0))}, 0, {.ctrl = true});
  EXPECT_EQ(local(box_).translation.x, 0.75f);
}

TEST_F(SessionTest, EscapeRevertsADrag) {
  session_.select({box_});
  session_.setTool(ToolMode::move);
  const float reach = 60.0f * metresPerPixel(session_.view(), vec3(0, 0.5f, 0));
  drag({pixelOf(vec3(reach, 0.5f, 0)), pixelOf(vec3(reach + 1, 0.5f, 0)),
        pixelOf(vec3(reach + 2, 0.5f, 0))},
       0, {}, {Key::escape});
  EXPECT_EQ(local(box_).translation, vec3(0, 0.5f, 0));
  EXPECT_FALSE(session_.editing().canUndo());
}

TEST_F(SessionTest, TheRingRotatesAboutItsAxisOnly) {
  session_.select({box_});
  session_.setTool(ToolMode::rotate);
  const vec3 centre(0, 0.5f, 0);
  const float r = 92.0f * metresPerPixel(session_.view(), centre);
  const auto on = [&](float a) { return pixelOf(centre + r * vec3(std::sin(a), 0, std::cos(a))); };
  drag({on(0.3f), on(0.5f), on(0.8f)});
  const Transform t = local(box_);
  EXPECT_NEAR(2.0f * std::atan2(t.rotation.y, t.rotation.w), 0.5f, 0.03f);
  EXPECT_NEAR(t.rotation.x, 0.0f, 1e-6f);
  EXPECT_EQ(t.scale, vec3(1.0f));
  EXPECT_LT(glm::length(t.translation - centre), 1e-5f);
}

TEST_F(SessionTest, TheScaleHandleScalesOneAxis) {
  session_.select({box_});
  session_.setTool(ToolMode::scale);
  const float reach = 60.0f * metresPerPixel(session_.view(), vec3(0, 0.5f, 0));
  drag({pixelOf(vec3(reach, 0.5f, 0)), pixelOf(vec3(2.0f * reach, 0.5f, 0))});
  EXPECT_NEAR(local(box_).scale.x, 2.0f, 0.05f);
  EXPECT_EQ(local(box_).scale.y, 1.0f);
}

TEST_F(SessionTest, AGroupMovesTogetherAndDescendantsOnce) {
  Document document = session_.document();
  const NodeId child = test::addNode(document.scene, "child", box_, vec3(1, 0, 0));
  session_.editing().open(std::move(document));
  session_.renderFrame();
  session_.select({child, light_, box_});
  session_.setTool(ToolMode::move);
  const float reach = 60.0f * metresPerPixel(session_.view(), vec3(0, 0.5f, 0));
  drag({pixelOf(vec3(reach, 0.5f, 0)), pixelOf(vec3(reach + 1.0f, 0.5f, 0))});
  EXPECT_NEAR(local(box_).translation.x, 1.0f, 0.02f);
  EXPECT_NEAR(local(light_).translation.x, 1.0f, 0.02f);
  EXPECT_EQ(local(child).translation, vec3(1, 0, 0))
      << "it is a descendant of the box and has moved with it";
}

TEST_F(SessionTest, OrbitingKeepsTheDistanceToThePivot) {
  const View before = session_.view();
  session_.frameSelection();
  const View framed = session_.view();
  EXPECT_LT(glm::length(framed.forward() - before.forward()), 1e-6f);
  const vec3 pivot = session_.renderer().scene().bounds.centre();
  const float distance = glm::length(framed.eye - pivot);
  drag({vec2(100, 100), vec2(130, 90), vec2(170, 120)}, 0, {.alt = true});
  EXPECT_GT(glm::length(session_.view().eye - framed.eye), 0.1f);
  EXPECT_NEAR(glm::length(session_.view().eye - pivot), distance, 1e-3f * distance);
  EXPECT_NEAR(session_.view().right().y, 0.0f, 1e-5f) << "the horizon stays level";
}

TEST_F(SessionTest, FlyingFollowsKeysAndTime) {
  ViewportInput in = at(vec2(100, 100));
  in.pressed[1] = in.down[1] = true;
  in.keys = {Key::w};
  in.seconds = 0.5f;
  const View before = session_.view();
  session_.viewport(in);
  EXPECT_TRUE(session_.flying());
  const vec3 way = session_.view().eye - before.eye;
  EXPECT_GT(glm::dot(way, before.forward()), 0.1f);
  in.pressed[1] = in.down[1] = false;
  in.keys = {};
  session_.viewport(in);
  EXPECT_FALSE(session_.flying());
}

TEST_F(SessionTest, FramingShowsTheSelection) {
  session_.select({box_});
  ASSERT_TRUE(session_.runAction("view.frame_selection"));
  for (int i = 0; i < 8; ++i) {
    const vec3 p = session_.view().project(
        vec3((i & 1) ? 0.5f : -0.5f, (i & 2) ? 1.0f : 0.0f, (i & 4) ? 0.5f : -0.5f));
    EXPECT_GT(p.z, 0.0f);
    EXPECT_TRUE(p.x > 0 && p.x < 320 && p.y > 0 && p.y < 200);
  }
}

TEST_F(SessionTest, DropPutsAnObjectOnTheFloorAndALightFacingAway) {
  const vec3 target(2, 0, 1);
  session_.select({box_});
  session_.viewport(at(pixelOf(target)));
  ASSERT_TRUE(session_.runAction("object.drop"));
  EXPECT_LT(glm::length(local(box_).translation - vec3(2, 0.5f, 1)), 0.01f);
  session_.select({light_});
  session_.viewport(at(pixelOf(vec3(-2, 0, 1))));
  ASSERT_TRUE(session_.runAction("object.drop"));
  const vec3 aim = local(light_).rotation * vec3(0, 0, -1);
  EXPECT_GT(aim.y, 0.999f);
  EXPECT_NEAR(local(light_).translation.y, 0.01f, 1e-4f);
}

TEST_F(SessionTest, ANewLightIsSelectedAndUndoRemovesIt) {
  const size_t nodes = session_.document().scene.nodes.size();
  for (const char* shape : {"rectangle", "disk", "sphere"}) {
    ASSERT_TRUE(session_.runAction(std::string("light.add ") + shape));
    const Node& n = *session_.document().scene.find(session_.document().active());
    ASSERT_TRUE(n.area.has_value());
    EXPECT_LT((n.local.rotation * vec3(0, 0, -1)).y, -0.999f);
    session_.renderFrame();
    session_.undo();
    EXPECT_EQ(session_.document().scene.nodes.size(), nodes);
    EXPECT_TRUE(session_.document().selection.empty());
  }
}

TEST_F(SessionTest, InvalidActionsChangeNothingAndAreReported) {
  const uint64_t before = documentHash(session_.document());
  for (const char* action :
       {"light.add cube", "light.add", "no.such", "object.move 1 2", "object.move 1 2 x",
        "render.set vpls=0", "render.set colour=1", "render.method magic", "camera.go nobody",
        "select.name nobody", "light.size -1", "\"unclosed", ""}) {
    session_.select({box_});
    EXPECT_FALSE(session_.runAction(action)) << action;
    EXPECT_FALSE(session_.status().empty());
  }
  EXPECT_EQ(documentHash(session_.document()), before);
  EXPECT_FALSE(session_.editing().canUndo());
}

TEST_F(SessionTest, SpaceTogglesTheReference) {
  const Action* action = session_.actions().forKey(Key::space, {});
  ASSERT_NE(action, nullptr);
  session_.perform(action->name);
  EXPECT_EQ(session_.document().render.method, "reference");
  session_.renderFrame();
  EXPECT_EQ(session_.renderError(), "");
  session_.perform(action->name);
  EXPECT_EQ(session_.document().render.method, "many_lights");
}

TEST_F(SessionTest, EveryKeyHasOneAction) {
  std::map<std::string, std::string> takenBy;
  for (const auto& [name, action] : session_.actions().all()) {
    EXPECT_FALSE(action.label.empty() || action.help.empty()) << name;
    if (action.shortcut.empty()) continue;
    EXPECT_TRUE(takenBy.emplace(action.shortcut, name).second)
        << name << " and " << takenBy[action.shortcut];
  }
  EXPECT_EQ(session_.actions().forKey(Key::z, {.ctrl = true, .shift = true})->name, "edit.redo");
  EXPECT_EQ(session_.actions().forKey(Key::y, {.ctrl = true})->name, "edit.redo");
  EXPECT_EQ(session_.actions().forKey(Key::del, {})->name, "edit.delete");
  EXPECT_EQ(session_.actions().forKey(Key::z, {}), nullptr);
}

TEST_F(SessionTest, UndoingTheMoveOfALightRestoresThePictureBitForBit) {
  const auto settle = [&] {
    while (!session_.renderFrame().settled) {
    }
    return session_.output().radiance->pixels().pixels;
  };
  const auto before = settle();
  session_.select({light_});
  ASSERT_TRUE(session_.runAction("object.move 1.5 3 0.5"));
  const auto moved = settle();
  EXPECT_NE(moved, before);
  session_.undo();
  EXPECT_EQ(settle(), before);
  session_.redo();
  EXPECT_EQ(settle(), moved);
}

TEST_F(SessionTest, TheOverlayShowsHandlesAndOutlines) {
  EXPECT_TRUE(session_.overlay().shapes.empty());
  session_.select({box_});
  const size_t outline = session_.overlay().shapes.size();
  EXPECT_EQ(outline, 12u);
  session_.setTool(ToolMode::move);
  EXPECT_GT(session_.overlay().shapes.size(), outline);
}

}  // namespace
}  // namespace lamplighter
