#include "renderer/patches/patch_set.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include <gtest/gtest.h>

#include "renderer/base/low_discrepancy.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

using test::renderSceneOf;

std::vector<Chart> findCharts(const RenderScene& world, uint32_t object) {
  return placeCharts(world, object, findTopology(world, object));
}

ObjectPatches makePatches(const RenderScene& world, uint32_t object) {
  return placePatches(world, object, findTopology(world, object));
}

RenderScene renderSceneOf(std::shared_ptr<const Mesh> mesh) {
  Scene scene;
  const NodeId id = test::addMesh(scene, std::move(mesh), vec3(1, 2, 3));
  scene.find(id)->local.rotation = glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, 3)));
  return renderSceneOf(scene);
}

// A grid of n × n squares in the XZ plane, displaced by `height`.
std::shared_ptr<const Mesh> grid(int n, float (*height)(float, float)) {
  auto mesh = std::make_shared<Mesh>();
  Primitive& p = mesh->primitives.emplace_back();
  for (int z = 0; z <= n; ++z) {
    for (int x = 0; x <= n; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(n);
      const float v = static_cast<float>(z) / static_cast<float>(n);
      p.positions.emplace_back(4.0f * u, height(u, v), 4.0f * v);
      p.normals.emplace_back(0, 1, 0);
    }
  }
  for (int z = 0; z < n; ++z) {
    for (int x = 0; x < n; ++x) {
      const auto i = static_cast<uint32_t>(z * (n + 1) + x),
                 below = i + static_cast<uint32_t>(n) + 1;
      p.indices.insert(p.indices.end(), {i, below, i + 1, i + 1, below, below + 1});
    }
  }
  return mesh;
}

TEST(Charts, ABoxHasSixConvexOnes) {
  const auto charts = findCharts(renderSceneOf(test::boxMesh(vec3(2, 1, 3))), 0);
  ASSERT_EQ(charts.size(), 6u);
  float area = 0.0f;
  for (const Chart& c : charts) {
    EXPECT_EQ(c.triangles.size(), 2u);
    EXPECT_EQ(c.outline.size(), 4u);
    EXPECT_LT(c.thickness, 1e-5f);
    // The axes of the chart are parallel to the sides: the bounding rectangle is not larger than
    // the face.
    EXPECT_NEAR((c.max.x - c.min.x) * (c.max.y - c.min.y), c.area, 1e-4f);
    area += c.area;
  }
  EXPECT_NEAR(area, 22.0f, 1e-3f);
}

// A finely divided floor is one chart whose outline has four corners.
TEST(Charts, AFinelyDividedFloorIsOneChart) {
  const auto charts = findCharts(renderSceneOf(grid(16, [](float, float) { return 0.0f; })), 0);
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_EQ(charts[0].triangles.size(), 512u);
  EXPECT_EQ(charts[0].outline.size(), 4u);
}

// Bumps of millimetres: the floor is still one chart, planar within a tolerance.
float bumps(float u, float v) { return 0.002f * std::sin(37.0f * u) * std::cos(31.0f * v); }

TEST(Charts, AFloorWithSmallBumpsIsOneRoughChart) {
  const auto charts = findCharts(renderSceneOf(grid(16, bumps)), 0);
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_TRUE(charts[0].isRough);
  EXPECT_EQ(charts[0].triangles.size(), 512u);
  EXPECT_GT(charts[0].thickness, 0.001f);
  EXPECT_LT(charts[0].thickness, 0.004f);
  EXPECT_TRUE(charts[0].outline.empty());
}

// A floor with a step consists of several planes. A floor without one corner has no convex outline.
TEST(Charts, ChartsEndWhereTheSurfaceBends) {
  const auto charts =
      findCharts(renderSceneOf(grid(16, [](float u, float) { return u > 0.5f ? 1.0f : 0.0f; })), 0);
  EXPECT_EQ(charts.size(), 3u);
  auto cut = std::make_shared<Mesh>(*grid(4, [](float, float) { return 0.0f; }));
  cut->primitives[0].indices.erase(cut->primitives[0].indices.begin(),
                                   cut->primitives[0].indices.begin() + 6);
  const auto rest = findCharts(renderSceneOf(cut), 0);
  ASSERT_EQ(rest.size(), 1u);
  EXPECT_TRUE(rest[0].outline.empty());
}

TEST(Charts, ACurvedSurfaceHasNone) {
  const auto mesh = grid(64, [](float u, float v) { return 2.0f * (u * u + v * v); });
  const RenderScene world = renderSceneOf(mesh);
  EXPECT_TRUE(findCharts(world, 0).empty());
  const ObjectPatches patches = makePatches(world, 0);
  ASSERT_EQ(patches.roots.size(), 1u);
  EXPECT_EQ(patches.patches[0].chart, kNone);
  EXPECT_FALSE(patches.patches[0].isLeaf());
}

// The kind of a mesh overrides the automatic choice: a box has six charts or none, and the facets
// of a curved surface can become charts.
TEST(Charts, FollowTheKindOfTheMesh) {
  Scene scene;
  const NodeId id = test::addMesh(scene, test::boxMesh(vec3(2, 1, 3)));
  EXPECT_EQ(findCharts(renderSceneOf(scene), 0).size(), 6u);
  scene.find(id)->meshKind = MeshKind::complex;
  EXPECT_TRUE(findCharts(renderSceneOf(scene), 0).empty());
  EXPECT_TRUE(compare(Scene(), scene).structure);

  Scene curved;
  const NodeId hill =
      test::addMesh(curved, grid(16, [](float u, float v) { return 2.0f * (u * u + v * v); }));
  EXPECT_TRUE(findCharts(renderSceneOf(curved), 0).empty());
  curved.find(hill)->meshKind = MeshKind::simple;
  EXPECT_GT(findCharts(renderSceneOf(curved), 0).size(), 250u);
}

// Every point of every triangle has a leaf and lies within it.
TEST(PatchSet, LeavesContainThePointsLookedUp) {
  const RenderScene world = renderSceneOf(test::randomBoxes(12, 4));
  std::set<int> seen;
  for (uint32_t object = 0; object < world.objects.size(); ++object) {
    const ObjectPatches patches = makePatches(world, object);
    const RenderObject& o = world.objects[object];
    for (uint32_t t = 0; t < o.triangleCount(); ++t) {
      const uint32_t* i = &world.indices[o.firstIndex + 3 * t];
      for (uint32_t k = 0; k < 200; ++k) {
        vec2 u = sobol2(k, t);
        if (u.x + u.y > 1.0f) u = 1.0f - u;
        const vec3& a = world.positions[i[0]];
        const vec3 p = a + u.x * (world.positions[i[1]] - a) + u.y * (world.positions[i[2]] - a);
        const int leaf = patches.leafAt(t, p);
        const Patch& patch = patches.patches[static_cast<size_t>(leaf)];
        ASSERT_TRUE(patch.isLeaf());
        ASSERT_NE(patch.chart, kNone);
        const vec2 q = patches.charts[static_cast<size_t>(patch.chart)].project(p);
        EXPECT_TRUE(q.x >= patch.min.x - 1e-4f && q.x <= patch.max.x + 1e-4f);
        EXPECT_TRUE(q.y >= patch.min.y - 1e-4f && q.y <= patch.max.y + 1e-4f);
        if (object == 0) seen.insert(leaf);
      }
    }
  }
  EXPECT_GT(seen.size(), 8u);  // the floor is divided
}

}  // namespace
}  // namespace lamplighter
