// Elements on surfaces: divided triangles without cracks, and clusters of small ones.
#include "renderer/surface_light/surface_shape.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "renderer/surface_light/triangle_division.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// One mesh of the given triangles, with flat normals and no shared vertices.
RenderScene sceneOf(const std::vector<std::array<vec3, 3>>& triangles) {
  Primitive p;
  for (const auto& t : triangles) {
    const vec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    for (const vec3& corner : t) {
      p.indices.push_back(static_cast<uint32_t>(p.positions.size()));
      p.positions.push_back(corner);
      p.normals.push_back(normal);
    }
  }
  Mesh mesh;
  mesh.primitives.push_back(p);
  Scene scene;
  test::addMesh(scene, std::make_shared<const Mesh>(mesh));
  return test::renderSceneOf(scene);
}

std::array<uint32_t, 3> cornersOf(const RenderScene& scene, uint32_t triangle) {
  const uint32_t* i = &scene.indices[3 * triangle];
  return {i[0], i[1], i[2]};
}

MeshPoint at(const SurfaceShape& shape, const RenderScene& scene, uint32_t triangle,
             const vec3& weights) {
  return pointOf(shape, {triangle, weights.y, weights.z}, cornersOf(scene, triangle));
}

// A value that differs for each sample.
float valueOf(const MeshPoint& p) {
  float sum = 0.0f;
  for (int c = 0; c < 3; ++c)
    sum += p.weights[c] * std::sin(7.0f * static_cast<float>(p.values[static_cast<size_t>(c)]));
  return sum;
}

TEST(TriangleDivision, ChildContainsThePoint) {
  for (int division = 1; division < kDivisions; ++division) {
    const TriangleDivision& d = triangleDivision(division);
    for (float x = 0.01f; x < 1.0f; x += 0.07f) {
      for (float y = 0.003f; x + y < 1.0f; y += 0.07f) {
        const vec3 before(1.0f - x - y, x, y);
        vec3 w = before;
        const int child = childAt(division, w);
        if (d.count == 0) continue;
        EXPECT_GE(std::min({w.x, w.y, w.z}), -1e-6f) << division;
        const vec3 expected = d.toChild[static_cast<size_t>(child)] * before;
        EXPECT_LT(glm::distance(w, expected), 1e-5f) << division;
      }
    }
  }
}

TEST(SurfaceShape, LightIsContinuousOverTheSharedEdgeOfUnequalTriangles) {
  // The second is long and thin, so that both are divided differently.
  const vec3 a(0, 0, 0), b(2.3f, 0, 0.1f), c(1.1f, 0, -1.9f), d(0.8f, 0, 0.4f);
  const RenderScene scene = sceneOf({{a, b, c}, {b, a, d}});
  const SurfaceShape shape = findSurfaceShape(scene, 0, {0.2f, false});
  ASSERT_GT(shape.leaves.size(), 100u);
  for (int i = 0; i <= 100; ++i) {
    const float t = static_cast<float>(i) / 100.0f;
    const MeshPoint first = at(shape, scene, 0, {1.0f - t, t, 0.0f});
    const MeshPoint second = at(shape, scene, 1, {t, 1.0f - t, 0.0f});
    EXPECT_NEAR(valueOf(first), valueOf(second), 1e-4f) << t;
  }
}

TEST(SurfaceShape, ElementsHaveShortEdgesAndCoverTheTriangle) {
  const vec3 a(0, 0, 0), b(3.0f, 0, 0), c(0.2f, 0, -1.7f);
  const RenderScene scene = sceneOf({{a, b, c}});
  const SurfaceShape shape = findSurfaceShape(scene, 0, {0.25f, false});
  const auto placeOf = [&](const SurfacePlace& p) {
    return (1.0f - p.u - p.v) * a + p.u * b + p.v * c;
  };
  double area = 0.0;
  for (const SurfaceShape::Leaf& leaf : shape.leaves) {
    std::array<vec3, 3> p;
    for (size_t k = 0; k < 3; ++k) p[k] = placeOf(shape.places[leaf.places.first + k]);
    // Places are halfway from the middle to the corners.
    for (size_t k = 0; k < 3; ++k) EXPECT_LE(glm::distance(p[k], p[(k + 1) % 3]), 0.1251f);
    area += 2.0 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
  }
  EXPECT_NEAR(area, 0.5 * 3.0 * 1.7, 1e-4);
}

TEST(SurfaceShape, ThinTrianglesGetFewerElements) {
  const RenderScene scene = sceneOf({{vec3(0), vec3(10, 0, 0), vec3(0, 0, -0.05f)}});
  const SurfaceShape shape = findSurfaceShape(scene, 0, {0.25f, false});
  EXPECT_LE(shape.leaves.size(), 800u);  // a quad-tree of this depth would have 4096
}

TEST(SurfaceShape, FineMeshesAreClustered) {
  Scene scene;
  test::addMesh(scene, test::sphereMesh(0.5f, 200));
  const RenderScene render = test::renderSceneOf(scene);
  ASSERT_GT(render.triangleCount(), 100000u);
  const SurfaceShape shape = findSurfaceShape(render, 0, {0.25f, false});
  EXPECT_TRUE(shape.nodes.empty());
  EXPECT_LT(shape.samples.size(), 300u);
  EXPECT_EQ(shape.leaves.size(), shape.samples.size());
  for (const SurfaceShape::Blend& blend : shape.blends) {
    float sum = 0.0f;
    for (size_t k = 0; k < blend.weights.size(); ++k) {
      EXPECT_GE(blend.weights[k], 0.0f);
      EXPECT_LT(blend.samples[k], shape.samples.size());
      sum += blend.weights[k];
    }
    EXPECT_NEAR(sum, 1.0f, 1e-5f);
  }
}

TEST(SurfaceShape, IsTheSameWhereverTheObjectIs) {
  Scene scene;
  const NodeId node = test::addMesh(scene, test::boxMesh(vec3(1.3f, 0.7f, 2.1f)));
  const auto shapeOfScene = [&] {
    return findSurfaceShape(test::renderSceneOf(scene), 0, {0.25f, false});
  };
  const SurfaceShape before = shapeOfScene();
  scene.find(node)->local.translation = vec3(3.1f, -2.0f, 0.3f);
  scene.find(node)->local.rotation = glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, 3)));
  const SurfaceShape after = shapeOfScene();
  ASSERT_EQ(before.places.size(), after.places.size());
  for (size_t i = 0; i < before.places.size(); ++i) {
    EXPECT_EQ(before.places[i].triangle, after.places[i].triangle);
    EXPECT_EQ(before.places[i].u, after.places[i].u);
    EXPECT_EQ(before.places[i].v, after.places[i].v);
  }
}

TEST(SurfaceShape, BacksHaveSamplesOfTheirOwn) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(1.0f));
  const RenderScene render = test::renderSceneOf(scene);
  const SurfaceShape one = findSurfaceShape(render, 0, {0.25f, false});
  const SurfaceShape two = findSurfaceShape(render, 0, {0.25f, true});
  EXPECT_EQ(two.samples.size(), 2 * one.samples.size());
  std::set<uint32_t> front, back;
  for (const float u : {0.1f, 0.5f, 0.8f}) {
    for (const uint32_t v : at(two, render, 0, {1.0f - u, u, 0.0f}).values) front.insert(v);
    const MeshPoint behind = pointOf(two, {two.triangles, u, 0.0f}, cornersOf(render, 0));
    for (const uint32_t v : behind.values) back.insert(v);
  }
  for (const uint32_t v : front) EXPECT_FALSE(back.contains(v));
}

}  // namespace
}  // namespace lamplighter
