#include "renderer/raycast/triangle_hit.h"

#include <random>

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

TEST(TriangleHit, GivesTheDistanceAndBarycentricsOfTheTarget) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> in(-1.0f, 1.0f), share(0.0f, 1.0f);
  const auto point = [&] { return vec3(in(random), in(random), in(random)); };
  int tested = 0;
  for (int i = 0; i < 1000; ++i) {
    const vec3 a = point(), b = point(), c = point(), origin = 3.0f * point();
    float u = share(random), v = share(random);
    if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
    const vec3 target = a + u * (b - a) + v * (c - a);
    const vec3 n = glm::cross(b - a, c - a), to = target - origin;
    // Slender triangles and grazing rays have larger rounding errors.
    if (glm::length(n) < 0.1f || std::abs(glm::dot(n, to)) < 0.1f * glm::length(to)) continue;
    ++tested;
    const TriangleHit hit = triangleHit(origin, 0.5f * to, 0.0f, 1e9f, a, b, c);
    EXPECT_NEAR(hit.t, 2.0f, 1e-4f);
    EXPECT_NEAR(hit.u, u, 1e-4f);
    EXPECT_NEAR(hit.v, v, 1e-4f);
  }
  EXPECT_GT(tested, 300);
}

TEST(TriangleHit, StaysWithinTheTriangleAndTheRay) {
  const vec3 a(0.0f), b(1, 0, 0), c(0, 1, 0), down(0, 0, -1);
  // Rays slightly outside, beside an edge and beside the vertex b, as rounding may produce.
  const TriangleHit edge = triangleHit({-1e-6f, 0.5f, 1.0f}, down, 0.0f, 10.0f, a, b, c);
  EXPECT_EQ(edge.u, 0.0f);
  const TriangleHit corner = triangleHit({1.000001f, 0.000001f, 1.0f}, down, 0.0f, 10.0f, a, b, c);
  EXPECT_LE(corner.u + corner.v, 1.0f);
  EXPECT_EQ(triangleHit({0.2f, 0.2f, 1.0f}, down, 0.0f, 0.5f, a, b, c).t, 0.5f);
  EXPECT_EQ(triangleHit({0.2f, 0.2f, 1.0f}, down, 1.5f, 9.0f, a, b, c).t, 1.5f);
  const TriangleHit along = triangleHit({-1.0f, 0.2f, 0.0f}, vec3(1, 0, 0), 0.25f, 9.0f, a, b, c);
  EXPECT_EQ(along.t, 0.25f);
}

}  // namespace
}  // namespace lamplighter
