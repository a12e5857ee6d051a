// Charts of meshes, and packing of rectangles on a page.
#include "renderer/atlas/unwrap.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "renderer/atlas/skyline.h"
#include "renderer/scene/render_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

RenderScene renderSceneOf(std::shared_ptr<const Mesh> mesh) {
  Scene scene;
  test::addMesh(scene, std::move(mesh));
  return test::renderSceneOf(scene);
}

size_t trianglesIn(const std::vector<MeshChart>& charts) {
  size_t count = 0;
  for (const MeshChart& c : charts) count += c.triangles.size();
  return count;
}

TEST(Skyline, PacksWithoutOverlapAndRejectsWhatDoesNotFit) {
  Skyline page(64);
  std::set<std::pair<int, int>> taken;
  int placed = 0;
  for (int i = 0; i < 40; ++i) {
    const glm::ivec2 size(5 + i % 7, 4 + i % 5);
    const auto at = page.place(size);
    if (!at) continue;
    ++placed;
    for (int y = at->y; y < at->y + size.y; ++y)
      for (int x = at->x; x < at->x + size.x; ++x) {
        ASSERT_TRUE(x >= 0 && y >= 0 && x < 64 && y < 64);
        EXPECT_TRUE(taken.emplace(x, y).second);
      }
  }
  EXPECT_EQ(placed, 40);
  EXPECT_FALSE(page.place({65, 1}));
  EXPECT_FALSE(page.place({64, 64}));
  EXPECT_FALSE(page.place({64, 64})) << "a rejected rectangle must not change the page";
}

TEST(Unwrap, ABoxHasSixCharts) {
  const RenderScene render = renderSceneOf(test::boxMesh(vec3(1, 2, 3)));
  const std::vector<MeshChart> charts = unwrap(render.positions, render.indices, 16.0f);
  ASSERT_EQ(charts.size(), 6u);
  EXPECT_EQ(trianglesIn(charts), 12u);
  float area = 0.0f;
  for (const MeshChart& c : charts) area += c.extent().x * c.extent().y;
  EXPECT_NEAR(area, 2.0f * (2 + 3 + 6), 1e-3f) << "each chart rectangle is as small as its side";
}

TEST(Unwrap, ASphereIsCutWhereItBends) {
  const RenderScene render = renderSceneOf(test::sphereMesh(1.0f, 24));
  const std::vector<MeshChart> charts = unwrap(render.positions, render.indices, 16.0f);
  EXPECT_EQ(trianglesIn(charts), render.objects[0].triangleCount());
  EXPECT_GE(charts.size(), 5u);
  EXPECT_LE(charts.size(), 40u);
  for (const MeshChart& c : charts) {
    for (const uint32_t t : c.triangles) {
      const uint32_t* i = &render.indices[3 * t];
      const vec3 n = glm::normalize(glm::cross(render.positions[i[1]] - render.positions[i[0]],
                                               render.positions[i[2]] - render.positions[i[0]]));
      EXPECT_GE(glm::dot(n, c.normal), std::cos(kMostBend) - 1e-4f);
    }
  }
}

// A spiral ramp of two turns. All its triangles are connected and nearly horizontal, but the second
// turn lies above the first, so their projections overlap.
TEST(Unwrap, ASurfaceThatOverlapsItselfInProjectionIsCut) {
  constexpr int kSteps = 64;
  auto mesh = std::make_shared<Mesh>();
  Primitive& p = mesh->primitives.emplace_back();
  for (int i = 0; i <= kSteps; ++i) {
    const float angle = 4.0f * kPi * static_cast<float>(i) / kSteps;
    const float height = 0.02f * static_cast<float>(i);
    for (const float r : {1.0f, 2.0f}) {
      p.positions.emplace_back(r * std::cos(angle), height, r * std::sin(angle));
      p.normals.emplace_back(0, 1, 0);
    }
  }
  for (uint32_t i = 0; i < kSteps; ++i)
    for (const uint32_t k : {0u, 2u, 1u, 1u, 2u, 3u}) p.indices.push_back(2 * i + k);
  const RenderScene render = renderSceneOf(mesh);
  const std::vector<MeshChart> charts = unwrap(render.positions, render.indices, 16.0f);
  EXPECT_EQ(trianglesIn(charts), 2u * kSteps);
  EXPECT_GE(charts.size(), 2u);
}

}  // namespace
}  // namespace lamplighter
