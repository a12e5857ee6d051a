// The tools that examine a point of the picture, used by action, key and click.
#include "editor/explain/point_tools.h"

#include "renderer/image/image.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

class PointToolsTest : public test::SessionFixture {
 protected:
  void SetUp() override {
    SessionFixture::SetUp();
    lookFrom(vec3(0, 3, 6), -0.5f);
    settle();
  }
  void settle() {
    for (int i = 0; i < 100 && !session_.renderFrame().settled; ++i) {
    }
  }
  bool run(const std::string& action, const vec3& at) {
    const vec2 p = pixelOf(at);
    return session_.runAction(action + " " + std::to_string(p.x) + " " + std::to_string(p.y));
  }
  const Explanation* answer() const { return session_.points().explainer().answer(); }
  vec2 click(const vec3& at) {
    press(pixelOf(at));
    release();
    return pixelOf(at);
  }
  // A plate between the lamp and the floor's middle right.
  void addMore(Scene& scene) override {
    const NodeId id = test::addMesh(scene, test::boxMesh(vec3(1.5f, 0.05f, 1.5f)), vec3(3, 1, 0));
    scene.find(id)->name = "plate";
    plate_ = id;
  }
  NodeId plate_ = 0;
  const vec3 shaded_{2.2f, 0.0f, 0.9f};
  const vec3 open_{-1.5f, 0.0f, 1.0f};
};

TEST_F(PointToolsTest, ExplainAtIsNotAStepAndSelectsBlockers) {
  const uint64_t before = hash();
  ASSERT_TRUE(run("explain.at", open_)) << session_.status();
  ASSERT_NE(answer(), nullptr);
  EXPECT_EQ(answer()->object, "floor");
  EXPECT_NEAR(glm::length(answer()->point.position - open_), 0.0f, 0.05f);
  EXPECT_GT(answer()->irradiance, 0.0f);
  EXPECT_EQ(answer()->lights.front().light, light_);
  EXPECT_FALSE(session_.runAction("explain.blocker 0"));  // no object blocks this light
  EXPECT_NE(session_.status().find("nothing blocks this light"), std::string::npos);
  EXPECT_FALSE(session_.runAction("explain.blocker 7"));
  EXPECT_FALSE(session_.runAction("explain.light 0.5"));

  // Move the plate between the box and the light.
  change([&](Scene& s) { s.find(plate_)->local.translation = vec3(-1.1f, 2.0f, 0.75f); });
  settle();
  ASSERT_NE(answer(), nullptr);
  EXPECT_EQ(answer()->lights.front().state, LightArrival::shadowed);
  ASSERT_TRUE(session_.runAction("explain.blocker 0 0")) << session_.status();
  EXPECT_EQ(session_.document().active(), plate_);
  EXPECT_TRUE(session_.runAction("explain.close"));
  EXPECT_EQ(answer(), nullptr);
  EXPECT_FALSE(session_.editing().canUndo());
  change([&](Scene& s) { s.find(plate_)->local.translation = vec3(3, 1, 0); });
  session_.select({});
  EXPECT_EQ(hash(), before);
}

TEST_F(PointToolsTest, TheExplanationFollowsTheObjectAndEdits) {
  ASSERT_TRUE(run("explain.at", vec3(0, 1, 0.3f)));
  ASSERT_EQ(answer()->object, "box");
  const float lux = answer()->irradiance;
  const float before = answer()->point.position.x;
  session_.select({box_});
  ASSERT_TRUE(session_.runAction("object.move 1 0.5 0"));
  settle();
  ASSERT_NE(answer(), nullptr);
  EXPECT_NEAR(answer()->point.position.x, before + 1.0f, 1e-4f);
  EXPECT_LT(answer()->irradiance, lux);
  ASSERT_TRUE(session_.runAction("edit.delete"));
  settle();
  EXPECT_EQ(answer(), nullptr);
}

TEST_F(PointToolsTest, ClicksExplainWhileTheToolIsActiveAndSelectOtherwise) {
  click(vec3(0, 0.5f, 0.5f));
  EXPECT_EQ(session_.document().active(), box_);
  ASSERT_TRUE(session_.runAction("tool.explain"));
  click(open_);
  ASSERT_NE(answer(), nullptr);
  EXPECT_EQ(answer()->object, "floor");
  EXPECT_EQ(session_.document().active(), box_);   // the selection stays
  ASSERT_TRUE(session_.runAction("select.none"));  // Escape ends the tool first
  EXPECT_EQ(session_.points().tool(), PointTool::none);
  EXPECT_EQ(session_.document().active(), box_);
  click(open_);
  EXPECT_EQ(session_.document().active(), floor_);
  ASSERT_TRUE(session_.runAction("tool.measure"));
  ASSERT_TRUE(session_.runAction("tool.move"));
  EXPECT_EQ(session_.points().tool(), PointTool::none);
}

TEST_F(PointToolsTest, ExplainsUnderThePointerByKey) {
  EXPECT_FALSE(session_.runAction("explain.pointer"));
  EXPECT_NE(session_.status().find("has not been over the picture"), std::string::npos);
  input_.pointer = pixelOf(open_);
  frame();
  const Action* action = session_.actions().forKey(Key::y, {});
  ASSERT_NE(action, nullptr);
  ASSERT_TRUE(session_.runAction(action->name));
  ASSERT_NE(answer(), nullptr);
  EXPECT_EQ(answer()->object, "floor");
}

TEST_F(PointToolsTest, WithoutASurfaceTheStatusSaysSo) {
  EXPECT_FALSE(session_.runAction("explain.at 160 1"));
  EXPECT_NE(session_.status().find("there is no surface"), std::string::npos);
  EXPECT_EQ(answer(), nullptr);
  EXPECT_FALSE(session_.runAction("measure.at 160 1"));
  EXPECT_FALSE(session_.runAction("explain.at 160"));
  EXPECT_TRUE(session_.runAction("probe.at 160 1"));
  EXPECT_EQ(session_.status(), "sky: 0 nt");
}

// On a diffuse floor, L = ρ E / π. The method uses shadow maps and the probe uses rays, so they
// differ slightly.
TEST_F(PointToolsTest, ProbeShowsIlluminanceAndLuminanceOfADiffuseSurface) {
  for (const char* method : {"many_lights", "reference"}) {
    SCOPED_TRACE(method);
    ASSERT_TRUE(session_.runAction(std::string("render.method ") + method));
    settle();
    ASSERT_TRUE(run("probe.at", open_));
    const auto& reading = session_.points().reading();
    ASSERT_TRUE(reading && reading->lux && reading->nits && reading->distance);
    EXPECT_EQ(reading->object, "floor");
    EXPECT_NEAR(*reading->nits / (0.6f * *reading->lux / kPi), 1.0f, 0.1f);
    EXPECT_NEAR(*reading->distance, glm::length(open_ - session_.view().eye), 0.05f);
    EXPECT_EQ(session_.status(), readingText(*reading));
  }
  ASSERT_TRUE(session_.runAction("view.light_only"));
  settle();
  ASSERT_TRUE(run("probe.at", open_));
  EXPECT_FALSE(session_.points().reading()->nits);  // this view shows white surfaces
}

TEST_F(PointToolsTest, ProbeFollowsThePointer) {
  ASSERT_TRUE(session_.runAction("view.probe"));
  EXPECT_FALSE(session_.points().reading());
  input_.pointer = pixelOf(open_);
  frame();
  session_.renderFrame();
  ASSERT_TRUE(session_.points().reading());
  const float lux = *session_.points().reading()->lux;
  EXPECT_GT(lux, 0.0f);
  EXPECT_FALSE(session_.overlay().texts.empty());
  input_.pointer = pixelOf(vec3(0, 0.5f, 0.5f));
  frame();
  session_.renderFrame();
  EXPECT_EQ(session_.points().reading()->object, "box");
  input_.hovered = false;
  frame();
  session_.renderFrame();
  EXPECT_FALSE(session_.points().reading());
}

TEST_F(PointToolsTest, TwoClicksMeasure) {
  ASSERT_TRUE(session_.runAction("measure.start"));
  const auto& m = session_.points().measurement();
  click(open_);
  EXPECT_TRUE(m.hasBegun());
  EXPECT_FALSE(m.isComplete());
  const vec3 other{2.0f, 0.0f, 2.0f};
  dragTo(pixelOf(other));
  ASSERT_TRUE(m.offset());  // the second point follows the pointer
  EXPECT_NEAR(glm::length(*m.offset() - (other - open_)), 0.0f, 1e-3f);
  click(other);
  ASSERT_TRUE(m.isComplete());
  EXPECT_EQ(m.text(), "3.640 m  (dx +3.500  dy +0.000  dz +1.000 m)");
  EXPECT_FALSE(session_.overlay().texts.empty());
  click(open_);
  EXPECT_FALSE(m.isComplete());  // a third click starts a new measurement
  ASSERT_TRUE(session_.runAction("measure.clear"));
  EXPECT_FALSE(m.hasBegun());
  ASSERT_TRUE(run("measure.at", open_));
  ASSERT_TRUE(run("measure.at", other));
  EXPECT_EQ(session_.status(), m.text());
  EXPECT_FALSE(session_.editing().canUndo());
}

}  // namespace
}  // namespace lamplighter
