// The importance of occluders against sums of exact solid angles, and the distribution by it.
#include "renderer/imperfect_maps/occluder_importance.h"

#include <cmath>

#include <gtest/gtest.h>

#include "renderer/base/threads.h"
#include "renderer/imperfect_maps/solid_angle.h"
#include "tests/renderer/imperfect_maps/occluder_scene.h"

namespace lamplighter {
namespace {

double exactAngle(const RenderScene& scene, const OccluderGroups& groups,
                  const OccluderGroup& group, const vec3& at) {
  double sum = 0.0;
  for (const OccluderTriangle& t : groups.trianglesOf(group)) {
    const uint32_t* i = &scene.indices[scene.objects[group.object].firstIndex + 3 * t.triangle];
    sum += static_cast<double>(
        solidAngle(at, scene.positions[i[0]], scene.positions[i[1]], scene.positions[i[2]]));
  }
  return sum;
}

// With 8 positions each group uses each of them.
TEST(OccluderImportance, IsTheMeanOfSolidAngles) {
  const RenderScene scene = test::renderSceneOf(test::occluderBodies());
  const OccluderGroups groups(scene);
  std::vector<vec3> positions;
  for (int i = 0; i < 8; ++i)
    positions.emplace_back(4.0f * std::cos(static_cast<float>(i)), 0.5f * static_cast<float>(i + 1),
                           4.0f * std::sin(static_cast<float>(i)));
  OccluderImportance importance;
  importance.update(scene, groups, positions, {}, {});
  double sum = 0.0, exactSum = 0.0;
  size_t near = 0;
  for (size_t g = 0; g < groups.groups().size(); ++g) {
    const OccluderGroup& group = groups.groups()[g];
    double exact = 0.0;
    for (const vec3& p : positions) exact += exactAngle(scene, groups, group, p) / 8.0;
    const double is = static_cast<double>(importance.weights()[g]);
    bool isNear = false;
    for (const vec3& p : positions)
      isNear = isNear || glm::distance(p, group.centre) < 1.99f * group.radius;
    if (group.count == 1 || isNear) {
      EXPECT_NEAR(is, exact, 1e-5 * exact + 1e-6);
      near += group.count > 1;
    } else {
      EXPECT_GT(is, 0.7 * exact) << g;
      EXPECT_LT(is, 1.4 * exact) << g;
      sum += is;
      exactSum += exact;
    }
  }
  EXPECT_GE(near, 1u);  // the floor
  EXPECT_NEAR(sum / exactSum, 1.0, 0.15);
}

// It would be 2π of the positions on it, wherever rounding moves them.
TEST(OccluderImportance, OfASurfaceIsNothingAtPlacesOnIt) {
  Scene level;
  const NodeId id = test::addMesh(level, test::squareMesh(2.0f), vec3(3.0f, 20.0f, 7.0f));
  level.find(id)->local.rotation = glm::angleAxis(0.6f, glm::normalize(vec3(1.0f, 2.0f, 0.5f)));
  const RenderScene scene = test::renderSceneOf(level);
  const OccluderGroups groups(scene);
  std::vector<vec3> view;
  for (int i = 0; i < 8; ++i) {
    const float u = 0.05f + 0.11f * static_cast<float>(i);
    view.push_back(
        glm::mix(scene.positions[1], glm::mix(scene.positions[0], scene.positions[2], u), 0.4f));
  }
  OccluderImportance importance;
  importance.update(scene, groups, view, {}, {});
  for (const float weight : importance.weights()) EXPECT_EQ(weight, 0.0f);
  for (vec3& p : view) p += 0.02f * scene.normals[0];
  importance.update(scene, groups, view, {}, {});
  float sum = 0.0f;
  for (const float weight : importance.weights()) sum += weight;
  EXPECT_GT(sum, 5.0f);
}

TEST(OccluderImportance, IsFiniteOnSurfaces) {
  const RenderScene scene = test::renderSceneOf(test::occluderBodies());
  const OccluderGroups groups(scene);
  OccluderImportance importance;
  for (const OccluderGroup& group : groups.groups()) {
    const vec3 at[] = {group.centre, scene.positions[scene.objects[group.object].firstVertex]};
    importance.update(scene, groups, at, {}, {});
    for (const float weight : importance.weights()) {
      ASSERT_GE(weight, 0.0f);
      ASSERT_LE(weight, 2.0f * kPi * kOccluderGroupTriangles);
    }
  }
}

TEST(OccluderImportance, HalfOfThePositionsAreThoseOfLights) {
  const RenderScene scene = test::renderSceneOf(test::occluderBodies());
  const OccluderGroups groups(scene);
  const vec3 view[] = {vec3(3.0f, 2.0f, 0.0f)}, lights[] = {vec3(-3.0f, 2.0f, 1.0f)};
  OccluderImportance ofView, ofLights, both;
  ofView.update(scene, groups, view, {}, {});
  ofLights.update(scene, groups, {}, lights, {});
  both.update(scene, groups, view, lights, {});
  for (size_t g = 0; g < groups.groups().size(); ++g) {
    const float mean = 0.5f * (ofView.weights()[g] + ofLights.weights()[g]);
    EXPECT_NEAR(both.weights()[g], mean, 1e-5f * mean);
  }
}

TEST(OccluderImportance, ChoosesGroupsByTheirShares) {
  const RenderScene scene = test::renderSceneOf(test::occluderBodies());
  const OccluderGroups groups(scene);
  const size_t count = groups.groups().size();
  const vec3 view[] = {vec3(3.0f, 1.5f, 0.0f)};
  constexpr double kShare = 0.25;
  for (const bool byArea : {true, false}) {
    OccluderImportance importance;
    importance.update(scene, groups, byArea ? std::span<const vec3>() : view, {}, {0.25f, 0});
    double weights = 0.0, area = 0.0, total = 0.0;
    for (size_t g = 0; g < count; ++g) {
      weights += static_cast<double>(importance.weights()[g]);
      area += static_cast<double>(groups.groups()[g].area);
    }
    constexpr uint32_t kNumbers = 1u << 18;
    std::vector<double> shares(count, 0.0);
    for (uint32_t i = 0; i < kNumbers; ++i) {
      const auto choice = importance.at((i + 0.5) / kNumbers);
      ASSERT_LT(choice.group, count);
      ASSERT_GE(choice.within, 0.0);
      ASSERT_LT(choice.within, 1.0);
      shares[choice.group] += 1.0 / kNumbers;
    }
    for (uint32_t g = 0; g < count; ++g) {
      const double share = static_cast<double>(groups.groups()[g].area) / area;
      const double expected =
          byArea ? share
                 : kShare * share +
                       (1.0 - kShare) * static_cast<double>(importance.weights()[g]) / weights;
      EXPECT_NEAR(importance.probability(g), expected, 1e-12);
      EXPECT_NEAR(shares[g], expected, 1.1 / kNumbers);
      total += importance.probability(g);
    }
    EXPECT_NEAR(total, 1.0, 1e-12);
  }
}

TEST(OccluderImportance, IsEmptyWithoutSurfaces) {
  const RenderScene scene = test::renderSceneOf({});
  const vec3 view[] = {vec3(0.0f)};
  OccluderImportance importance;
  EXPECT_TRUE(importance.empty());
  importance.update(scene, OccluderGroups(scene), view, {}, {});
  EXPECT_TRUE(importance.empty());
}

TEST(OccluderImportance, DoesNotDependOnThreads) {
  Scene level = test::occluderBodies();
  test::addMesh(level, test::sphereMesh(2.0f, 100), vec3(4.0f));
  const RenderScene scene = test::renderSceneOf(level);
  std::vector<vec3> view;
  for (int i = 0; i < 100; ++i) view.emplace_back(0.1f * static_cast<float>(i), 2.0f, 1.0f);
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    OccluderImportance importance;
    importance.update(scene, OccluderGroups(scene), view, {}, {});
    return std::vector<float>(importance.weights().begin(), importance.weights().end());
  };
  EXPECT_EQ(with(1), with(4));
}

}  // namespace
}  // namespace lamplighter
