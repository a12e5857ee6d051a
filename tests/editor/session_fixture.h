// A session with a scene of a floor, a box and a light. Tests use pointer and keys as the ui does.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "editor/session/session.h"
#include "editor/tools/projection.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter::test {

class SessionFixture : public testing::Test {
 protected:
  Session session_{std::make_unique<FrameRenderer>(makeCpuBackend())};
  NodeId floor_ = 0, box_ = 0, light_ = 0;
  ViewportInput input_;  // of the last frame

  virtual void addMore(Scene&) {}  // adds further nodes of a test

  void SetUp() override {
    Scene scene;
    const int grey = addMaterial(scene, vec3(0.6f));
    floor_ = addMesh(scene, squareMesh(10.0f, grey));
    box_ = addMesh(scene, boxMesh(vec3(1.0f), grey), vec3(0, 0.5f, 0));
    scene.find(floor_)->name = "floor";
    scene.find(box_)->name = "box";
    light_ = addRectangleLight(scene, vec3(0, 4, 0), vec2(1.0f), vec3(10.0f));
    addMore(scene);
    open(std::move(scene));
  }

  void open(Scene scene) {
    session_.resizeViewport(320, 200);
    session_.open(std::move(scene), "test.gltf", {});
    lookFrom(vec3(0, 2, 6), -0.25f);
    RenderSettings r = session_.document().render;
    r.values.set("vpls", 16);
    r.values.set("map_resolution", 16);
    session_.editing().setInitialRender(r);
    session_.renderFrame();
    input_ = {};
    input_.hovered = true;
  }

  // Changes the level without an edit and clears the history.
  void change(const std::function<void(Scene&)>& f) {
    Document document = session_.document();
    f(document.scene);
    session_.editing().open(std::move(document));
  }

  // Looks towards −Z, with a pitch in radians.
  void lookFrom(const vec3& eye, float pitch) {
    View view = session_.view();
    view.eye = eye;
    view.orientation = glm::angleAxis(pitch, vec3(1, 0, 0));
    session_.setView(view);
  }

  vec2 pixelOf(const vec3& world) const { return vec2(session_.view().project(world)); }
  const Node& node(NodeId id) const { return *session_.document().scene.find(id); }
  const Transform& local(NodeId id) const { return node(id).local; }
  vec3 placeOf(NodeId id) const { return vec3(worldMatrix(session_.document().scene, id)[3]); }
  uint64_t hash() const { return documentHash(session_.document()); }

  // Expects that the action is one step with undo and redo.
  void expectOneStep(const std::string& action) {
    const uint64_t before = hash();
    const size_t steps = session_.history().position();
    ASSERT_TRUE(session_.runAction(action)) << action << ": " << session_.status();
    const uint64_t after = hash();
    EXPECT_NE(after, before) << action;
    EXPECT_EQ(session_.history().position(), steps + 1) << action;
    session_.undo();
    EXPECT_EQ(hash(), before) << action;
    session_.redo();
    EXPECT_EQ(hash(), after) << action;
  }

  // One frame of a drag per call.
  void press(const vec2& at, int button = 0, Modifiers modifiers = {}) {
    input_.pointer = at;
    input_.modifiers = modifiers;
    session_.viewport(input_);  // moves the pointer without a button
    input_.pressed[button] = input_.down[button] = true;
    frame();
  }
  void dragTo(const vec2& at) {
    input_.pointer = at;
    frame();
  }
  void release(int button = 0) {
    input_.down[button] = false;
    input_.released[button] = true;
    frame();
    input_.modifiers = {};
  }
  void frame() {
    session_.viewport(input_);
    for (int i = 0; i < 3; ++i) input_.pressed[i] = input_.released[i] = false;
    input_.wheel = 0.0f;
  }

  // The length of `pixels` on the screen at `origin`, in metres. Finds points on gizmo handles.
  float along(const vec3& origin, float pixels = 60.0f) const {
    return pixels * metresPerPixel(session_.view(), origin);
  }
  // Presses the X arrow of the selection.
  void pressXArrow(Modifiers modifiers = {}) {
    const vec3 origin = placeOf(session_.document().active());
    press(pixelOf(origin + vec3(along(origin), 0, 0)), 0, modifiers);
  }
};

}  // namespace lamplighter::test
