// A level in another unit of length is edited as in metres: every length scales with it.
#include <gtest/gtest.h>

#include "editor/session/session.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "tests/support/scenes/scaled_scene.h"

namespace lamplighter {
namespace {

// A session with the room of all lights, `factor` times as large, and the same view of it.
struct Level {
  explicit Level(float factor) {
    session.resizeViewport(160, 100);
    session.open(test::scaledScene(test::roomOfAllLights(), factor), "test.gltf", {});
    const float opened = glm::length(session.view().eye) / factor;
    EXPECT_GT(opened, 4.0f);
    EXPECT_LT(opened, 20.0f);
    EXPECT_LT(session.view().znear, 0.1f * factor);
    speedAfterOpening = session.cameraSpeed();
    View view = test::scaledView(test::viewOfRoom(160, 100), factor);
    session.setView(view);
    RenderSettings render = session.document().render;
    render.values.set("vpls", 16);
    render.values.set("map_resolution", 16);
    session.editing().setInitialRender(render);
    session.renderFrame();
  }
  void click(const vec2& pointer) {
    ViewportInput in;
    in.pointer = pointer;
    in.hovered = true;
    session.viewport(in);
    in.pressed[0] = in.down[0] = true;
    session.viewport(in);
    in.pressed[0] = in.down[0] = false;
    in.released[0] = true;
    session.viewport(in);
  }
  void perform(const std::string& action) {
    EXPECT_TRUE(session.runAction(action)) << session.status();
    session.renderFrame();
  }

  Session session{std::make_unique<FrameRenderer>(makeCpuBackend())};
  float speedAfterOpening = 0.0f;
};

class ScaledLevel : public testing::TestWithParam<float> {
 protected:
  float factor_ = GetParam();
  Level metres_{1.0f}, other_{factor_};

  void expectScaled(const vec3& metres, const vec3& other) const {
    EXPECT_LT(glm::length(other / factor_ - metres), 1e-4f);
  }
};

TEST_P(ScaledLevel, TheCameraFliesAsFast) {
  EXPECT_FLOAT_EQ(other_.speedAfterOpening, factor_ * metres_.speedAfterOpening);
  for (Level* level : {&metres_, &other_}) level->session.frameAll();
  expectScaled(metres_.session.view().eye, other_.session.view().eye);
}

TEST_P(ScaledLevel, ClicksSelectTheSame) {
  for (int y = 5; y < 100; y += 18) {
    for (int x = 5; x < 160; x += 15) {
      for (Level* level : {&metres_, &other_})
        level->click(vec2(static_cast<float>(x), static_cast<float>(y)));
      EXPECT_EQ(metres_.session.document().selection, other_.session.document().selection);
    }
  }
}

TEST_P(ScaledLevel, NewLightsAndPlacedObjectsScaleWithIt) {
  for (Level* level : {&metres_, &other_}) {
    level->perform("light.add tube");
    level->session.startPlacing("light.add disk");
    level->click(vec2(60.0f, 80.0f));
  }
  const auto& a = metres_.session.document().scene.nodes;
  const auto& b = other_.session.document().scene.nodes;
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    expectScaled(a[i].local.translation, b[i].local.translation);
    if (a[i].area) {
      expectScaled(vec3(a[i].area->size, 0.0f), vec3(b[i].area->size, 0.0f));
      EXPECT_NEAR(b[i].area->radiance.r / a[i].area->radiance.r, 1.0f, 1e-3f);
    }
  }
}

TEST_P(ScaledLevel, PointsAreMeasuredInMetres) {
  const vec2 pixel(70.0f, 75.0f);
  const Reading a = metres_.session.points().probeAt(metres_.session.pointSubject(), pixel);
  const Reading b = other_.session.points().probeAt(other_.session.pointSubject(), pixel);
  ASSERT_TRUE(a.distance && b.distance && a.lux && b.lux);
  EXPECT_FLOAT_EQ(*b.distance, factor_ * *a.distance);
  EXPECT_FLOAT_EQ(*b.lux, *a.lux);
}

INSTANTIATE_TEST_SUITE_P(Units, ScaledLevel, testing::Values(0x1p-10f, 0x1p10f));

}  // namespace
}  // namespace lamplighter
