// Points on surfaces: uniform by area, stratified, and determined by their arguments.
#include "renderer/sampling/surface_sampler.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A sphere with triangles of many sizes, a small box, and a transparent pane.
Scene bodies() {
  Scene scene;
  const int grey = test::addMaterial(scene, vec3(0.5f)), glass = test::addMaterial(scene, vec3(1));
  scene.materials[static_cast<size_t>(glass)].transmission = 1.0f;
  test::addMesh(scene, test::sphereMesh(1.0f, 6, 0.2f, grey));
  test::addMesh(scene, test::boxMesh(vec3(0.5f, 0.2f, 0.1f), grey), vec3(3, 0, 0));
  test::addMesh(scene, test::squareMesh(9.0f, glass));
  return scene;
}

double areaOf(const RenderScene& s, uint32_t object, uint32_t triangle) {
  const uint32_t* i = &s.indices[s.objects[object].firstIndex + 3 * triangle];
  return 0.5 * static_cast<double>(glm::length(glm::cross(s.positions[i[1]] - s.positions[i[0]],
                                                          s.positions[i[2]] - s.positions[i[0]])));
}

TEST(SurfaceSampler, TrianglesAreChosenByArea) {
  const RenderScene scene = test::renderSceneOf(bodies());
  const SurfaceSampler sampler(scene);
  constexpr uint32_t kPoints = 20000;
  std::vector<std::vector<int>> counts(3);
  for (size_t i = 0; i < 3; ++i) counts[i].assign(scene.objects[i].triangleCount(), 0);
  // One point of each of many sequences, so that the points are independent.
  for (uint32_t i = 0; i < kPoints; ++i) {
    const SampledPoint p = sampler.at(5, 1000 + i);
    ASSERT_GE(p.u, 0.0f);
    ASSERT_GE(p.v, 0.0f);
    ASSERT_LE(p.u + p.v, 1.0f + 1e-6f);
    ++counts[p.object][p.triangle];
  }
  double chi2 = 0.0;
  int degrees = -1;
  for (uint32_t object = 0; object < 2; ++object) {
    for (uint32_t t = 0; t < counts[object].size(); ++t) {
      const double expected = kPoints * areaOf(scene, object, t) / sampler.area();
      if (expected < 5.0) continue;
      chi2 += (counts[object][t] - expected) * (counts[object][t] - expected) / expected;
      ++degrees;
    }
  }
  EXPECT_LT(chi2, degrees + 4.0 * std::sqrt(2.0 * degrees)) << degrees;  // four standard deviations
  for (const int count : counts[2]) EXPECT_EQ(count, 0) << "rays pass through the pane";
}

TEST(SurfaceSampler, BlocksOfIndicesAreStratified) {
  Scene scene;
  for (int i = 0; i < 8; ++i) test::addMesh(scene, test::squareMesh(1.0f), vec3(2 * i, 0, 0));
  const SurfaceSampler sampler(test::renderSceneOf(scene));
  for (const uint32_t first : {0u, 8u, 64u}) {
    std::vector<int> counts(8, 0);
    for (uint32_t i = first; i < first + 8; ++i) ++counts[sampler.at(i, 3).object];
    EXPECT_EQ(counts, std::vector<int>(8, 1)) << first;
  }
}

// Also within a triangle: the mean of the points is its centroid.
TEST(SurfaceSampler, PointsAreUniformInATriangle) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(1.0f));
  const SurfaceSampler sampler(test::renderSceneOf(scene));
  vec2 mean(0.0f);
  int count = 0;
  for (uint32_t i = 0; i < 4096; ++i) {
    const SampledPoint p = sampler.at(i, 1);
    if (p.triangle != 0) continue;
    mean += vec2(p.u, p.v);
    ++count;
  }
  EXPECT_EQ(count, 2048);
  EXPECT_NEAR(mean.x / 2048.0f, 1.0f / 3.0f, 2e-3f);
  EXPECT_NEAR(mean.y / 2048.0f, 1.0f / 3.0f, 2e-3f);
}

TEST(SurfaceSampler, AfterChangesItEqualsANewOne) {
  Scene scene = bodies();
  RenderScene render = test::renderSceneOf(scene);
  SurfaceSampler sampler(render);
  const auto edit = [&](const std::function<void(Scene&)>& change) {
    const Scene before = scene;
    change(scene);
    sampler.update(render, update(render, scene, compare(before, scene)));
    const SurfaceSampler expected(render);
    EXPECT_EQ(sampler.area(), expected.area());
    for (uint32_t i = 0; i < 64; ++i) {
      const SampledPoint a = sampler.at(i, 9), b = expected.at(i, 9);
      EXPECT_TRUE(a.object == b.object && a.triangle == b.triangle && a.u == b.u && a.v == b.v);
    }
  };
  edit([](Scene& s) { s.nodes[0].local.scale = vec3(2, 1, 1); });
  edit([](Scene& s) { s.materials[1].transmission = 0.0f; });
  edit([](Scene& s) { s.nodes.pop_back(); });
}

}  // namespace
}  // namespace lamplighter
