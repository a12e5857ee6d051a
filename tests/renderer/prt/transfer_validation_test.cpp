// The choice of lights that are left to pixels, by the errors at check points.
#include "renderer/prt/transfer_validation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// Lights at two check points: exact light and error at the first and at the second.
struct Lights {
  std::vector<LightErrors> all;
  std::vector<bool> isHeld;
  void add(const LightError& first, const LightError& second, bool held = true) {
    all.push_back({first, second});
    isHeld.push_back(held);
  }
  std::vector<bool> leave(float mostError) const { return lightsToLeave(all, isHeld, mostError); }
};

// Ten lights of the same small error, so that up to a sixth of the lights may be left to pixels.
Lights manySmall() {
  Lights out;
  for (int i = 0; i < 10; ++i) out.add({0.1f, 0.0001f}, {0.1f, 0.0001f});
  return out;
}

TEST(LightsToLeave, AreNoneIfTheErrorIsSmall) {
  EXPECT_EQ(manySmall().leave(0.01f), std::vector<bool>(10, false));
}

TEST(LightsToLeave, AreThoseOfLargestErrorUntilTheSumIsSmall) {
  Lights lights = manySmall();
  lights.add({1.0f, 0.5f}, {1.0f, -0.5f});
  lights.add({1.0f, 0.1f}, {1.0f, 0.0f});
  std::vector<bool> expected(12, false);
  EXPECT_EQ(lights.leave(0.2f), expected) << "sqrt(0.5 · (0.6² + 0.5²)) / 3 = 0.18";
  expected[10] = true;
  EXPECT_EQ(lights.leave(0.1f), expected);
  EXPECT_EQ(lights.leave(0.03f), expected);
  expected[11] = true;
  EXPECT_EQ(lights.leave(0.01f), expected);
}

TEST(LightsToLeave, ErrorsOfLightsMayCancel) {
  Lights lights = manySmall();
  lights.add({1.0f, 0.5f}, {1.0f, 0.5f});
  lights.add({1.0f, -0.5f}, {1.0f, -0.5f});
  EXPECT_EQ(lights.leave(0.01f), std::vector<bool>(12, false)) << "the errors cancel";
}

TEST(LightsToLeave, AreAllIfTooManyExceedTheLimit) {
  Lights lights;
  for (int i = 0; i < 9; ++i) lights.add({1.0f, i < 4 ? 0.5f : 0.01f}, {1.0f, 0.0f});
  lights.add({1.0f, 0.0f}, {1.0f, 0.0f}, false);
  std::vector<bool> expected(10, true);
  expected[9] = false;  // already shaded per pixel
  EXPECT_EQ(lights.leave(0.02f), expected);
}

// Errors are relative to at least a quarter of the mean, so that errors at dark points do not
// matter.
TEST(LightsToLeave, ErrorsAtDarkPointsAreTolerated) {
  Lights lights = manySmall();
  lights.add({1.0f, 0.0f}, {0.0f, 0.0f});
  for (LightErrors& light : lights.all) light[1].exact = light[0].error = light[1].error = 0.0f;
  lights.all[0][1].error = 0.02f;  // a point without any light
  EXPECT_EQ(lights.leave(0.06f), std::vector<bool>(11, false)) << "0.02 / √2 / (1/4 of 1) = 0.057";
  EXPECT_TRUE(lights.leave(0.02f)[0]);
}

TEST(LightsToLeave, AreAllIfNoLightArrives) {
  Lights lights;
  lights.add({0.0f, 0.1f}, {0.0f, 0.0f});
  lights.all.emplace_back();  // no check point sees this light
  lights.isHeld.push_back(true);
  EXPECT_EQ(lights.leave(0.5f), (std::vector<bool>{true, false}));
}

// A sphere with transfer and light points.
class CheckedSphere : public testing::Test {
 protected:
  CheckedSphere() {
    test::addMesh(scene_, test::sphereMesh(0.5f, 32), vec3(1, 2, 3));
    update(render_, scene_, SceneChanges::all());
    space_ = ownSpaceOf(render_.objects[0]).value();
    own_ = ownSceneOf(render_, 0, space_);
    transfer_ = computeTransfer(own_, {256, 0}).value();
    points_ = placeIncidentLightPoints(own_, 32);
    for (const vec3& p : points_.places)
      places_.push_back(space_.scale * (space_.rotation * p) + space_.translation);
  }
  std::vector<ValidationPoint> placed(bool isLit = true) const {
    return placeValidationPoints(own_, transfer_, points_,
                                 std::vector<bool>(own_.triangleCount(), isLit));
  }
  Scene scene_;
  RenderScene render_, own_;
  OwnSpace space_;
  Transfer transfer_;
  IncidentLightPoints points_;
  std::vector<vec3> places_;
};

TEST_F(CheckedSphere, IsCheckedOnAllSides) {
  const auto checks = placed();
  ASSERT_EQ(checks.size(), 64u);
  vec3 mean(0.0f);
  for (const ValidationPoint& check : checks) {
    EXPECT_NEAR(glm::length(check.place), 0.5f, 0.01f);
    EXPECT_NEAR(glm::dot(check.normal, glm::normalize(check.place)), 1.0f, 0.01f);
    EXPECT_NEAR(glm::dot(check.plane, check.normal), 1.0f, 0.01f);
    mean += check.place / 64.0f;
    // The sum of the transfer over all light points.
    float sum = 0.0f;
    for (const ValidationPoint::Term& term : check.terms) sum += term.direct[0];
    EXPECT_NEAR(sum, cosineTransfer(check.normal)[0], 1e-4f);
  }
  EXPECT_LT(glm::length(mean), 0.1f);
  EXPECT_TRUE(placed(false).empty());
}

TEST_F(CheckedSphere, FindsTheErrors) {
  const RayCaster rays(render_);
  const auto checks = placed();
  shared::Vpl vpl = test::makeVpl(vec3(1, 22, 3), vec3(0, -1, 0));
  vpl.intensity = vec3(400.0f);
  std::vector<uint8_t> hidden(places_.size(), 0);
  uint64_t traced = 0;
  LightErrors out = checkLight(checks, space_, rays, vpl, places_, hidden, 0.0f, traced);
  EXPECT_GT(traced, 16u);
  ASSERT_EQ(out.size(), checks.size());
  for (size_t c = 0; c < out.size(); ++c) {
    const float cosine = std::max(checks[c].normal.y, 0.0f);
    EXPECT_NEAR(out[c].exact, cosine, 0.07f) << "400 W/sr from 20 m, 0.5 m nearer on top";
    EXPECT_NEAR(out[c].error, 0.0f, 0.07f) << "truncation error";
  }
  // The light points claim that the light is hidden, although it is visible.
  hidden.assign(hidden.size(), 1);
  out = checkLight(checks, space_, rays, vpl, places_, hidden, 0.0f, traced);
  ASSERT_EQ(out.size(), checks.size());
  for (const LightError& light : out) EXPECT_EQ(light.error, -light.exact);
  // A light that faces away.
  vpl.normal = vec4(0, 1, 0, 0);
  EXPECT_TRUE(checkLight(checks, space_, rays, vpl, places_, hidden, 0.0f, traced).empty());
}

}  // namespace
}  // namespace lamplighter
