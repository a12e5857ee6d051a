// The light that each light source gives to a point, compared with closed forms: a small lamp above
// a floor, and a plate between them.
#include "editor/explain/explanation.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr float kHeight = 2.0f, kSide = 0.1f, kRadiance = 800.0f;
constexpr float kUnder = kRadiance * kSide * kSide / (kHeight * kHeight);  // E = L A / h² [lx]

class Explaining : public testing::TestWithParam<const char*> {
 protected:
  Explaining() {
    black_ = test::addMaterial(scene_, vec3(0.0f));
    white_ = test::addMaterial(scene_, vec3(0.8f));
    floor_ = test::addMesh(scene_, test::squareMesh(20.0f, black_));
    scene_.find(floor_)->name = "floor";
    lamp_ = test::addRectangleLight(scene_, vec3(0, kHeight, 0), vec2(kSide), vec3(kRadiance));
    scene_.find(lamp_)->name = "lamp";
    settings_.set("vpls", 64);
    settings_.set("map_resolution", 16);
    settings_.set("antialias", 1);
  }
  NodeId addPlate(const vec3& at, const vec3& size) {
    const NodeId id = test::addMesh(scene_, test::boxMesh(size, black_), at);
    scene_.find(id)->name = "plate";
    return id;
  }
  // Explains the light at a point of the floor.
  Explanation explainAt(const vec3& floorPoint) {
    const std::string method = GetParam();
    GiOutput out = render(method, SceneChanges::all());
    for (int i = 0; i < 50 && !out.settled && method == "many_lights"; ++i)
      out = render(method, SceneChanges());
    const LightSamples samples =
        lightSamples(renderer_.inspect(), renderer_.scene(), *renderer_.rays(), settings_);
    const PickedPoint point{floor_, floorPoint, vec3(0, 1, 0), vec3(0, 1, 0)};
    const Explanation e = explain(scene_, renderer_.scene(), *renderer_.rays(), point, samples);
    EXPECT_NEAR(irradianceAt(*renderer_.rays(), point, samples), e.irradiance,
                1e-5f * e.irradiance);
    return e;
  }
  GiOutput render(const std::string& method, const SceneChanges& changes) {
    const View view = test::lookAt(vec3(0, 3, 6), vec3(0), 32, 20);
    return renderer_.render({scene_, changes, view, method, settings_});
  }
  const LightShare& shareOf(const Explanation& e, NodeId id) {
    const auto found = std::find_if(e.lights.begin(), e.lights.end(),
                                    [&](const LightShare& l) { return l.light == id; });
    EXPECT_NE(found, e.lights.end());
    return *found;
  }

  Scene scene_;
  int black_ = 0, white_ = 0;
  NodeId floor_ = 0, lamp_ = 0;
  Settings settings_;
  FrameRenderer renderer_{makeCpuBackend()};
};

TEST_P(Explaining, ALampAboveAFloorFollowsTheInverseSquareLaw) {
  const Explanation e = explainAt(vec3(0));
  EXPECT_EQ(e.object, "floor");
  ASSERT_EQ(e.lights.size(), 1u);
  const LightShare& lamp = e.lights[0];
  EXPECT_EQ(lamp.light, lamp_);
  EXPECT_EQ(lamp.name, "lamp");
  EXPECT_EQ(lamp.state, LightArrival::lit);
  EXPECT_EQ(lamp.seen, lamp.samples);
  EXPECT_NEAR(lamp.direct / kUnder, 1.0f, 2e-3f);
  EXPECT_EQ(lamp.bounced, 0.0f);  // all surfaces are black
  EXPECT_EQ(lamp.withheld, 0.0f);
  EXPECT_TRUE(lamp.blockers.empty());
  EXPECT_FLOAT_EQ(e.shareOf(lamp), 1.0f);
  // At 45° cos · cos / d² is a quarter of that.
  EXPECT_NEAR(explainAt(vec3(kHeight, 0, 0)).irradiance / kUnder, 0.25f, 2e-3f);
}

TEST_P(Explaining, APlateInBetweenIsNamedWithTheLightThatItBlocks) {
  const NodeId plate = addPlate(vec3(0, 1, 0), vec3(1.0f, 0.1f, 1.0f));
  const Explanation e = explainAt(vec3(0));
  const LightShare& lamp = shareOf(e, lamp_);
  EXPECT_EQ(lamp.state, LightArrival::shadowed);
  EXPECT_EQ(lamp.seen, 0);
  EXPECT_GT(lamp.facing, 10);
  EXPECT_EQ(e.irradiance, 0.0f);
  EXPECT_EQ(e.shareOf(lamp), 0.0f);
  EXPECT_NEAR(lamp.withheld / kUnder, 1.0f, 2e-3f);
  ASSERT_EQ(lamp.blockers.size(), 1u);
  EXPECT_EQ(lamp.blockers[0].node, plate);
  EXPECT_EQ(lamp.blockers[0].name, "plate");
  EXPECT_EQ(lamp.blockers[0].samples, lamp.facing);
  EXPECT_FLOAT_EQ(lamp.blockers[0].withheld, lamp.withheld);
}

// The plate's edge is under the middle of the lamp, so half of it is hidden.
TEST_P(Explaining, APlateThatHidesHalfOfALampBlocksHalfOfItsLight) {
  addPlate(vec3(0.5f, 1, 0), vec3(1.0f, 0.001f, 1.0f));
  const LightShare lamp = shareOf(explainAt(vec3(0)), lamp_);
  EXPECT_EQ(lamp.state, LightArrival::partly);
  EXPECT_NEAR(lamp.direct / kUnder, 0.5f, 0.06f);
  EXPECT_NEAR((lamp.direct + lamp.withheld) / kUnder, 1.0f, 2e-3f);
  EXPECT_GT(lamp.seen, 0);
  EXPECT_LT(lamp.seen, lamp.facing);
}

TEST_P(Explaining, GivesTheReasonForEachLightThatDoesNotArrive) {
  const NodeId below = test::addRectangleLight(scene_, vec3(0, -1, 0), vec2(0.1f), vec3(kRadiance));
  const NodeId hidden = test::addRectangleLight(scene_, vec3(1, 2, 0), vec2(0.1f), vec3(kRadiance));
  scene_.find(hidden)->visible = false;
  const NodeId black = test::addRectangleLight(scene_, vec3(1, 2, 0), vec2(0.1f), vec3(0.0f));
  const Explanation e = explainAt(vec3(0));
  ASSERT_EQ(e.lights.size(), 4u);
  EXPECT_EQ(e.lights[0].light, lamp_);  // sorted by contribution
  EXPECT_EQ(shareOf(e, below).state, LightArrival::away);
  EXPECT_EQ(shareOf(e, hidden).state, LightArrival::off);
  EXPECT_EQ(shareOf(e, black).state, LightArrival::off);
}

TEST_P(Explaining, ASunAndASkyAreParallelLight) {
  scene_.find(lamp_)->area.reset();
  PunctualLight sun{PunctualKind::directional, vec3(3.0f)};
  scene_.find(lamp_)->punctual = sun;  // straight down
  scene_.sky = vec3(0.5f);
  const Explanation e = explainAt(vec3(0.3f, 0, 0.1f));
  EXPECT_NEAR(shareOf(e, lamp_).direct, 3.0f, 1e-3f);
  const LightShare& sky = shareOf(e, kNoNode);
  EXPECT_EQ(sky.name, "sky");
  EXPECT_NEAR(sky.direct / (kPi * 0.5f), 1.0f, 0.05f);  // E = π L
}

TEST_P(Explaining, BouncedLightIsCountedForItsSource) {
  settings_.set("vpls", 2000);
  // The plate hides the lamp from the point, and a white wall reflects the light of the lamp.
  scene_.find(lamp_)->area->radiance = vec3(8000.0f);
  addPlate(vec3(0, 1, 0), vec3(0.5f, 0.01f, 0.5f));
  NodeId ceiling =
      test::addMesh(scene_, test::boxMesh(vec3(0.1f, 4.0f, 6.0f), white_), vec3(2.0f, 2.0f, 0));
  scene_.find(ceiling)->name = "wall";
  const Explanation e = explainAt(vec3(0));
  const LightShare& lamp = shareOf(e, lamp_);
  EXPECT_EQ(lamp.direct, 0.0f);
  EXPECT_GT(lamp.bounced, 0.0f);
  EXPECT_GT(lamp.bouncedSeen, 0);
  EXPECT_FLOAT_EQ(e.shareOf(lamp), 1.0f);
}

INSTANTIATE_TEST_SUITE_P(Methods, Explaining, testing::Values("many_lights", "reference"));

}  // namespace
}  // namespace lamplighter
