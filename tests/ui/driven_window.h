// The editor's window without a display. Tests send the input of a user.
#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "tests/support/scenes/scenes.h"
#include "ui/app/application.h"
#include "ui/platform/headless.h"

namespace lamplighter::test {

inline std::unique_ptr<Session> newSession() {
  return std::make_unique<Session>(std::make_unique<FrameRenderer>(makeCpuBackend()));
}

// A floor below a light, which renders quickly.
inline Scene litFloor() {
  Scene scene;
  addMesh(scene, squareMesh(4.0f));
  addRectangleLight(scene, vec3(0, 2, 0), vec2(1.0f), vec3(5.0f));
  return scene;
}

class DrivenWindow {
 public:
  explicit DrivenWindow(int width = 960, int height = 600, float scale = 1.0f)
      : platform_(width, height, false, scale) {
    app_.setTimeStep(1.0f / 60.0f);
    RenderSettings render = session().document().render;
    render.values.set("vpls", 8);
    render.values.set("map_resolution", 16);
    session().editing().setInitialRender(std::move(render));
  }
  Application& app() { return app_; }
  Session& session() { return app_.session(); }

  void open(Scene scene) {
    frames(2);
    session().open(std::move(scene), "test.gltf", {});
    frames(3);
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) app_.frame();
  }
  void click(const std::string& widget) {
    ASSERT_TRUE(shows(widget)) << widget;
    InputEvent move{EventKind::pointer};
    move.target = widget;
    move.position = vec2(0.5f);
    app_.input().push(move);
    frames(2);
    for (const bool down : {true, false}) {
      InputEvent button{EventKind::button};
      button.down = down;
      app_.input().push(button);
      frames(2);
    }
    frames(2);  // widgets are registered one frame later
  }
  void key(Key key, bool down) {
    InputEvent event{EventKind::key};
    event.key = key;
    event.down = down;
    app_.input().push(event);
    frames(1);
  }
  void act(const std::string& text) {
    InputEvent event{EventKind::action};
    event.text = text;
    app_.input().push(event);
    frames(3);
  }
  const WidgetMap::Place* place(const std::string& widget) { return app_.widgets().find(widget); }
  bool shows(const std::string& widget) { return place(widget) != nullptr; }

 private:
  Headless platform_;
  Application app_{platform_, newSession()};
};

}  // namespace lamplighter::test
