// Points of occluders: their density, their even spread, and how they follow changes.
#include "renderer/imperfect_maps/occluder_points.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "renderer/base/error.h"
#include "renderer/base/threads.h"
#include "tests/renderer/imperfect_maps/occluder_scene.h"

namespace lamplighter {
namespace {

const std::vector<vec3> kView{vec3(3.0f, 1.5f, 0.2f), vec3(2.5f, 1.2f, 0.0f)};

OccluderPointOptions options(uint32_t maps, uint32_t pointsPerMap, uint32_t seed = 0) {
  OccluderPointOptions o;
  o.pointsPerMap = pointsPerMap;
  o.points = maps * pointsPerMap;
  o.importance.seed = seed;
  return o;
}

OccluderPoints freshPoints(const RenderScene& scene, std::span<const vec3> view,
                           const OccluderPointOptions& o) {
  OccluderPoints points;
  points.update(scene, {}, view, {}, o);
  return points;
}

// All arrays but the places of points without area, which do not matter.
void expectEqual(const OccluderPoints& a, const OccluderPoints& b) {
  const OccluderPointArrays &x = a.arrays(), &y = b.arrays();
  EXPECT_EQ(x.area, y.area);
  EXPECT_EQ(x.px, y.px);
  EXPECT_EQ(x.py, y.py);
  EXPECT_EQ(x.pz, y.pz);
  EXPECT_EQ(x.nx, y.nx);
  EXPECT_EQ(x.ny, y.ny);
  EXPECT_EQ(x.nz, y.nz);
  EXPECT_EQ(x.object, y.object);
  EXPECT_EQ(x.triangle, y.triangle);
  EXPECT_EQ(x.u, y.u);
  EXPECT_EQ(x.v, y.v);
}

double totalArea(const OccluderGroups& groups) {
  double area = 0.0;
  for (uint32_t i = 0; i < groups.objects(); ++i) area += groups.areaOf(i);
  return area;
}

double areaOf(const OccluderPoints& points, uint32_t first, uint32_t count) {
  double sum = 0.0;
  for (uint32_t j = first; j < first + count; ++j)
    sum += static_cast<double>(points.arrays().area[j]);
  return sum;
}

// One point of each of many sequences, so that the points are independent. χ² over triangles with
// enough points expected; the rest counts as one.
void expectDensity(const RenderScene& scene, std::span<const vec3> view) {
  constexpr uint32_t kSequences = 1500, kPoints = 64;
  std::vector<std::vector<double>> counts(scene.objects.size());
  for (size_t i = 0; i < counts.size(); ++i) counts[i].assign(scene.objects[i].triangleCount(), 0);
  // The positions of each group depend on the seed too, so they are chosen of one.
  const std::vector<vec3> one(view.begin(),
                              view.begin() + std::min<ptrdiff_t>(1, std::ssize(view)));
  OccluderPoints points;
  for (uint32_t seed = 0; seed < kSequences; ++seed) {
    points.update(scene, {}, one, {}, options(1, kPoints, seed));
    const uint32_t j = seed % kPoints;
    ++counts[points.arrays().object[j]][points.arrays().triangle[j]];
  }
  const OccluderGroups& groups = points.groups();
  double chi2 = 0.0, restCount = kSequences, restExpected = kSequences;
  int degrees = 0;
  for (uint32_t g = 0; g < groups.groups().size(); ++g) {
    const OccluderGroup& group = groups.groups()[g];
    float before = 0.0f;
    for (const OccluderTriangle& t : groups.trianglesOf(group)) {
      const double share = static_cast<double>((t.areaUpTo - before) / group.area);
      before = t.areaUpTo;
      const double expected = kSequences * share * points.importance().probability(g);
      if (expected < 5.0) continue;
      const double count = counts[group.object][t.triangle];
      chi2 += (count - expected) * (count - expected) / expected;
      restCount -= count;
      restExpected -= expected;
      ++degrees;
    }
  }
  if (restExpected > 5.0)
    chi2 += (restCount - restExpected) * (restCount - restExpected) / restExpected;
  EXPECT_GE(degrees, 2);
  EXPECT_LT(chi2, degrees + 4.0 * std::sqrt(2.0 * degrees)) << degrees;
  for (const double count : counts[3]) EXPECT_EQ(count, 0.0) << "rays pass through the pane";
}

TEST(OccluderPoints, AreUniformByAreaWithoutPositions) {
  expectDensity(test::renderSceneOf(test::occluderBodies()), {});
}

TEST(OccluderPoints, HaveTheDensityOfTheImportance) {
  expectDensity(test::renderSceneOf(test::occluderBodies()), kView);
}

TEST(OccluderPoints, AreDenserNearTheView) {
  const RenderScene scene = test::renderSceneOf(test::occluderBodies());
  const auto on = [&](const OccluderPoints& points, uint32_t object) {
    return std::ranges::count(points.arrays().object, object);
  };
  const OccluderPoints near = freshPoints(scene, kView, options(1, 1024)),
                       even = freshPoints(scene, {}, options(1, 1024));
  EXPECT_GT(on(near, 1), 20 * std::max<ptrdiff_t>(on(even, 1), 1));  // the box beside the view
  EXPECT_GT(on(near, 4), 50);                                        // the floor has some, too
}

// Each block, each eighth of it, and its first points.
TEST(OccluderPoints, StandForTheWholeArea) {
  const RenderScene scene = test::renderSceneOf(test::occluderBodies());
  for (const bool adapts : {false, true}) {
    const OccluderPoints points =
        freshPoints(scene, adapts ? std::span(kView) : std::span<const vec3>(), options(4, 1024));
    const double whole = totalArea(points.groups());
    for (uint32_t block = 0; block < 4; ++block)
      EXPECT_NEAR(areaOf(points, 1024 * block, 1024), whole, adapts ? 0.05 * whole : 1e-4 * whole);
    for (uint32_t eighth = 0; eighth < 32; ++eighth)
      EXPECT_NEAR(8.0 * areaOf(points, 128 * eighth, 128), whole,
                  adapts ? 0.2 * whole : 1e-4 * whole);
    EXPECT_NEAR(areaOf(points, 0, 4096), 4.0 * whole, 0.04 * whole);
  }
}

// Eight equal squares: each eighth of a block has as many on each, in their order; so has every
// second of its points.
TEST(OccluderPoints, AreStratifiedInEachPartOfABlock) {
  Scene level;
  for (int i = 0; i < 8; ++i) test::addMesh(level, test::squareMesh(1.0f), vec3(2 * i, 0, 0));
  const RenderScene scene = test::renderSceneOf(level);
  const OccluderPoints points = freshPoints(scene, {}, options(4, 128, 5));
  for (const uint32_t part : {16u, 128u}) {
    for (uint32_t first = 0; first < points.size(); first += part) {
      for (const uint32_t step : {1u, 2u}) {
        std::vector<uint32_t> counts(8, 0);
        for (uint32_t j = first; j < first + part; j += step) ++counts[points.arrays().object[j]];
        EXPECT_EQ(counts, std::vector<uint32_t>(8, part / 8 / step)) << part << " from " << first;
      }
    }
  }
  for (uint32_t j = 1; j < 16; ++j)
    EXPECT_GE(points.arrays().object[j], points.arrays().object[j - 1]) << j;
}

TEST(OccluderPoints, LieOnTheirTriangles) {
  const RenderScene scene = test::renderSceneOf(test::occluderBodies());
  const OccluderPoints points = freshPoints(scene, kView, options(2, 256));
  const OccluderPointArrays& p = points.arrays();
  EXPECT_EQ(reinterpret_cast<uintptr_t>(p.px.data()) % 32, 0u);
  for (uint32_t j = 0; j < points.size(); ++j) {
    ASSERT_GE(p.u[j], 0.0f);
    ASSERT_GE(p.v[j], 0.0f);
    ASSERT_LE(p.u[j] + p.v[j], 1.0f + 1e-6f);
    const uint32_t* i = &scene.indices[scene.objects[p.object[j]].firstIndex + 3 * p.triangle[j]];
    const vec3 &a = scene.positions[i[0]], &b = scene.positions[i[1]], &c = scene.positions[i[2]];
    const vec3 at(p.px[j], p.py[j], p.pz[j]), n(p.nx[j], p.ny[j], p.nz[j]);
    ASSERT_NEAR(glm::length(n), 1.0f, 1e-5f);
    ASSERT_NEAR(glm::dot(n, glm::normalize(glm::cross(b - a, c - a))), 1.0f, 1e-5f);
    ASSERT_NEAR(glm::dot(n, at - a), 0.0f, 1e-5f);
  }
}

// A level and points that follow its edits.
struct Edited {
  Scene scene = test::occluderBodies();
  RenderScene render = test::renderSceneOf(scene);
  OccluderPoints points = freshPoints(render, kView, options(2, 256));

  bool edit(const std::function<void(Scene&)>& change, std::span<const vec3> view = kView) {
    const Scene before = scene;
    change(scene);
    return points.update(render, update(render, scene, compare(before, scene)), view, {},
                         points.options());
  }
  bool waitOne(std::span<const vec3> view = kView) {
    return points.update(render, {}, view, {}, points.options());
  }
};

TEST(OccluderPoints, FollowAMovedObjectAtOnce) {
  Edited level;
  const OccluderPointArrays before = level.points.arrays();
  EXPECT_TRUE(level.edit([](Scene& s) { s.nodes[1].local.translation += vec3(0.0f, 0.0f, 1.0f); }));
  const OccluderPointArrays& after = level.points.arrays();
  uint32_t followed = 0;
  for (uint32_t j = 0; j < level.points.size(); ++j) {
    if (level.points.ageOf(j) == 0) continue;  // drawn again
    const bool isMoved = before.object[j] == 1;
    followed += isMoved;
    ASSERT_EQ(after.object[j], before.object[j]);
    ASSERT_EQ(after.px[j], before.px[j]);
    ASSERT_NEAR(after.pz[j], before.pz[j] + (isMoved ? 1.0f : 0.0f), 1e-5f);
    ASSERT_NEAR(after.area[j], before.area[j], 1e-5f * before.area[j]);
  }
  EXPECT_GT(followed, 20u);
  EXPECT_EQ(level.points.pendingFrames(), 7u);
}

TEST(OccluderPoints, OfScaledObjectsStandForTheirNewArea) {
  Edited level;
  const OccluderPointArrays before = level.points.arrays();
  level.edit([](Scene& s) { s.nodes[1].local.scale = vec3(3.0f); });
  for (uint32_t j = 0; j < level.points.size(); ++j) {
    if (level.points.ageOf(j) == 0) continue;
    const float growth = before.object[j] == 1 ? 9.0f : 1.0f;
    ASSERT_NEAR(level.points.arrays().area[j], before.area[j] * growth, 1e-4f * before.area[j]);
  }
}

TEST(OccluderPoints, OfVanishedObjectsHaveNoArea) {
  Edited level;
  level.edit([](Scene& s) { s.materials[1].transmission = 0.0f; });
  const OccluderPointArrays before = level.points.arrays();
  level.edit([](Scene& s) { s.nodes[3].visible = false; });
  uint32_t gone = 0;
  for (uint32_t j = 0; j < level.points.size(); ++j) {
    if (level.points.ageOf(j) == 0) {
      ASSERT_NE(level.points.arrays().object[j], 3u);
      ASSERT_GT(level.points.arrays().area[j], 0.0f);
    } else if (before.object[j] == 3) {
      ++gone;
      ASSERT_EQ(level.points.arrays().area[j], 0.0f);
    }
  }
  EXPECT_GT(gone, 50u);
}

// The scene is rebuilt.
TEST(OccluderPoints, LeaveObjectsThatBecomeClear) {
  Edited level;
  level.edit([](Scene& s) { s.materials[0].transmission = 1.0f; });
  EXPECT_EQ(areaOf(level.points, 0, 64), 0.0) << "nothing is left";
  level.edit([](Scene& s) { s.materials[0].transmission = 0.0f; });
  EXPECT_GT(areaOf(level.points, 0, 64), 0.0);
}

TEST(OccluderPoints, AreThoseOfAFreshStartAfterEightQuietUpdates) {
  Edited level;
  std::vector<vec3> view = kView;
  level.edit([](Scene& s) { s.nodes[0].local.translation.x = 1.0f; });
  level.edit([](Scene& s) { s.nodes[2].visible = false; });
  level.waitOne();
  level.edit([](Scene& s) { s.nodes[2].visible = true; });
  level.edit([](Scene& s) { s.nodes[4].local.scale = vec3(2.0f, 1.0f, 1.0f); });
  view[0].x += 0.5f;
  level.waitOne(view);
  EXPECT_FALSE(level.points.isSettled());
  int updates = 0;
  while (level.waitOne(view)) ++updates;
  EXPECT_LE(updates, 8);
  EXPECT_TRUE(level.points.isSettled());
  expectEqual(level.points, freshPoints(level.render, view, level.points.options()));
}

TEST(OccluderPoints, AreDrawnByEighthsWhileTheViewMoves) {
  Edited level;
  EXPECT_TRUE(level.points.isSettled());
  EXPECT_FALSE(level.waitOne());
  for (uint32_t frame = 1; frame <= 10; ++frame) {
    const vec3 view[] = {kView[0] + vec3(0.1f * static_cast<float>(frame))};
    const OccluderPointArrays before = level.points.arrays();
    EXPECT_TRUE(level.waitOne(view));
    EXPECT_EQ(level.points.pendingFrames(), 7u);
    uint32_t drawn = 0;
    for (uint32_t j = 0; j < level.points.size(); ++j) {
      drawn += level.points.ageOf(j) == 0;
      if (level.points.ageOf(j) != 0) {
        ASSERT_EQ(level.points.arrays().px[j], before.px[j]);
      }
      ASSERT_LT(level.points.ageOf(j), 8u + (frame < 8 ? 8u : 0u));
    }
    EXPECT_EQ(drawn, level.points.size() / 8);
  }
}

TEST(OccluderPoints, StartAfreshWithOtherOptions) {
  Edited level;
  OccluderPointOptions other = options(3, 128, 9);
  EXPECT_TRUE(level.points.update(level.render, {}, kView, {}, other));
  EXPECT_TRUE(level.points.isSettled());
  expectEqual(level.points, freshPoints(level.render, kView, other));
  other.pointsPerMap = 96;
  EXPECT_THROW(level.points.update(level.render, {}, kView, {}, other), InputError);
  other.pointsPerMap = 256;
  EXPECT_THROW(level.points.update(level.render, {}, kView, {}, other), InputError);
}

TEST(OccluderPoints, OfAnEmptySceneHaveNoArea) {
  const OccluderPoints points = freshPoints(test::renderSceneOf({}), kView, options(1, 64));
  EXPECT_EQ(areaOf(points, 0, 64), 0.0);
}

TEST(OccluderPoints, DoNotDependOnThreads) {
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    Edited level;
    level.edit([](Scene& s) { s.nodes[0].local.translation.x = 1.0f; });
    level.waitOne();
    return level.points;
  };
  expectEqual(with(1), with(4));
}

TEST(OccluderPoints, OfTheDefaultNumberFitInto4MiB) {
  const RenderScene scene = test::renderSceneOf(test::occluderBodies());
  const OccluderPoints points = freshPoints(scene, kView, {});
  EXPECT_EQ(points.size(), 131072u);
  EXPECT_EQ(points.poolBytes(), points.size() * size_t{44});
  EXPECT_LE(points.size() * 7 * sizeof(float), size_t{4} << 20);
}

}  // namespace
}  // namespace lamplighter
