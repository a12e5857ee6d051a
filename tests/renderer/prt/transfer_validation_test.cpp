// Which lights are left to pixels, and by what that is decided.
#include "renderer/prt/transfer_validation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/lit_scene.h"
#include "tests/support/scenes.h"

namespace lamplighter {
namespace {

// Lights over two check points: exact light and error at the first, then at the second.
struct Lights {
  std::vector<LightErrors> all;
  std::vector<bool> isHeld;
  void add(const LightError& first, const LightError& second, bool held = true) {
    all.push_back({first, second});
    isHeld.push_back(held);
  }
  std::vector<bool> leave(float mostError) const { return lightsToLeave(all, isHeld, mostError); }
};

// As many of a small error each as there are lights, so that few may be left.
Lights manySmall() {
  Lights out;
  for (int i = 0; i < 10; ++i) out.add({0.1f, 0.0001f}, {0.1f, 0.0001f});
  return out;
}

TEST(LightsToLeave, AreNoneWhereTheErrorIsSmall) {
  EXPECT_EQ(manySmall().leave(0.01f), std::vector<bool>(10, false));
}

TEST(LightsToLeave, AreThoseOfLargestErrorUntilItIsSmall) {
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

TEST(LightsToLeave, AreCountedTogether) {
  Lights lights = manySmall();
  lights.add({1.0f, 0.5f}, {1.0f, 0.5f});
  lights.add({1.0f, -0.5f}, {1.0f, -0.5f});
  EXPECT_EQ(lights.leave(0.01f), std::vector<bool>(12, false)) << "they make up for each other";
}

TEST(LightsToLeave, AreAllWhereTheyAreMany) {
  Lights lights;
  for (int i = 0; i < 9; ++i) lights.add({1.0f, i < 4 ? 0.5f : 0.01f}, {1.0f, 0.0f});
  lights.add({1.0f, 0.0f}, {1.0f, 0.0f}, false);
  std::vector<bool> expected(10, true);
  expected[9] = false;  // that is at pixels anyhow
  EXPECT_EQ(lights.leave(0.02f), expected);
}

// An error is a share of a quarter of the mean at least, so that what is black asks for no pixels.
TEST(LightsToLeave, MayGetTheDarkWrong) {
  Lights lights = manySmall();
  lights.add({1.0f, 0.0f}, {0.0f, 0.0f});
  for (LightErrors& light : lights.all) light[1].exact = light[0].error = light[1].error = 0.0f;
  lights.all[0][1].error = 0.02f;  // at a point where there is no light at all
  EXPECT_EQ(lights.leave(0.06f), std::vector<bool>(11, false)) << "0.02 / √2 / (1/4 of 1) = 0.057";
  EXPECT_TRUE(lights.leave(0.02f)[0]);
}

TEST(LightsToLeave, AreAllThatArriveNowhere) {
  Lights lights;
  lights.add({0.0f, 0.1f}, {0.0f, 0.0f});
  lights.all.emplace_back();  // arrives nowhere, and is not said to
  lights.isHeld.push_back(true);
  EXPECT_EQ(lights.leave(0.5f), (std::vector<bool>{true, false}));
}

// A sphere, with its transfer and light points.
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

TEST_F(CheckedSphere, IsCheckedAllOver) {
  const auto checks = placed();
  ASSERT_EQ(checks.size(), 64u);
  vec3 mean(0.0f);
  for (const ValidationPoint& check : checks) {
    EXPECT_NEAR(glm::length(check.place), 0.5f, 0.01f);
    EXPECT_NEAR(glm::dot(check.normal, glm::normalize(check.place)), 1.0f, 0.01f);
    EXPECT_NEAR(glm::dot(check.plane, check.normal), 1.0f, 0.01f);
    mean += check.place / 64.0f;
    // All weights of its vertices' light points, and theirs.
    float sum = 0.0f;
    for (const ValidationPoint::Term& term : check.terms) sum += term.direct[0];
    EXPECT_NEAR(sum, cosineTransfer(check.normal)[0], 1e-4f);
  }
  EXPECT_LT(glm::length(mean), 0.1f);
  EXPECT_TRUE(placed(false).empty());
}

TEST_F(CheckedSphere, KnowsWhatIsWrong) {
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
    EXPECT_NEAR(out[c].error, 0.0f, 0.07f) << "what is cut off";
  }
  // Light points that say it is hidden, where it is not.
  hidden.assign(hidden.size(), 1);
  out = checkLight(checks, space_, rays, vpl, places_, hidden, 0.0f, traced);
  ASSERT_EQ(out.size(), checks.size());
  for (const LightError& light : out) EXPECT_EQ(light.error, -light.exact);
  // A light that shines elsewhere.
  vpl.normal = vec4(0, 1, 0, 0);
  EXPECT_TRUE(checkLight(checks, space_, rays, vpl, places_, hidden, 0.0f, traced).empty());
}

}  // namespace
}  // namespace lamplighter
