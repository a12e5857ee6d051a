// The form factor of a mesh by its outlines.
#include "renderer/bias_compensation/mesh_factor.h"

#include <gtest/gtest.h>

#include "renderer/base/random.h"
#include "renderer/scene/light_shapes.h"
#include "renderer/surface_light/form_factor.h"

namespace lamplighter {
namespace {

std::vector<vec3> cornersOf(AreaShape shape, vec2 size) {
  AreaLight light;
  light.shape = shape;
  light.size = size;
  const Primitive p = tessellate(light);
  std::vector<vec3> corners;
  for (const uint32_t i : p.indices) corners.push_back(p.positions[i]);
  return corners;
}

// Triangle by triangle.
double sumOf(const std::vector<vec3>& corners, bool bothSides, const vec3& x, const vec3& n) {
  double sum = 0.0;
  for (size_t i = 0; i < corners.size(); i += 3) {
    const vec3& a = corners[i];
    const vec3 cross = glm::cross(corners[i + 1] - a, corners[i + 2] - a);
    if (bothSides || glm::dot(cross, x - a) > 0.0f)
      sum += static_cast<double>(polygonFactor(x, n, std::span(corners).subspan(i, 3)));
  }
  return sum;
}

vec3 randomVector(uint32_t k, uint32_t set) {
  return vec3(toUnitFloat(hash4(k, 0, set, 1)), toUnitFloat(hash4(k, 1, set, 1)),
              toUnitFloat(hash4(k, 2, set, 1))) *
             2.0f -
         1.0f;
}

class MeshFactorOfShapes : public testing::TestWithParam<std::tuple<AreaShape, bool>> {};

// Outside and inside, above and across the horizon.
TEST_P(MeshFactorOfShapes, IsTheSumOfItsTriangles) {
  const auto [shape, bothSides] = GetParam();
  const std::vector<vec3> corners = cornersOf(shape, vec2(1.2f, 0.5f));
  const MeshFactor factor(corners, bothSides);
  int lit = 0, across = 0;
  for (uint32_t k = 0; k < 400; ++k) {
    const vec3 x = 1.5f * randomVector(k, 7), n = glm::normalize(randomVector(k, 8));
    const double expected = sumOf(corners, bothSides, x, n);
    const auto found = static_cast<double>(factor.at(x, n));
    // Single precision decides which triangles near the outline face the point.
    EXPECT_NEAR(found, expected, 2e-4 + 1e-3 * expected) << k;
    lit += expected > 0.01;
    across += expected > 0.01 && glm::length(x - glm::dot(x, n) * n) > 0.0f &&
              std::abs(glm::dot(x, n)) < 0.3f;
  }
  EXPECT_GT(lit, 40);
  EXPECT_GT(across, 5);
}
INSTANTIATE_TEST_SUITE_P(All, MeshFactorOfShapes,
                         testing::Combine(testing::Values(AreaShape::rectangle, AreaShape::disk,
                                                          AreaShape::sphere, AreaShape::tube),
                                          testing::Bool()));

// (r/d)² cos θ of the disk that a sphere looks like, times π.
TEST(MeshFactor, OfASphereAboveTheHorizon) {
  const MeshFactor factor(cornersOf(AreaShape::sphere, vec2(1.0f)), false);
  for (const float d : {0.8f, 1.5f, 4.0f}) {
    const vec3 x(0.0f, -d, 0.0f), n = glm::normalize(vec3(0.3f, 1.0f, 0.1f));
    if (d * n.y < 0.55f) continue;
    const float expected = kPi * 0.25f / (d * d) * n.y;
    EXPECT_NEAR(factor.at(x, n) / expected, 1.0f, 0.01f) << d;
  }
}

// All of the hemisphere.
TEST(MeshFactor, InsideOfATwoSidedSphereIsPi) {
  const MeshFactor factor(cornersOf(AreaShape::sphere, vec2(2.0f)), true);
  EXPECT_NEAR(factor.at(vec3(0.1f, 0.2f, 0.0f), glm::normalize(vec3(1, 2, 3))), kPi, 1e-4f);
  const MeshFactor outside(cornersOf(AreaShape::sphere, vec2(2.0f)), false);
  EXPECT_EQ(outside.at(vec3(0.1f, 0.2f, 0.0f), vec3(0, 1, 0)), 0.0f);
}

}  // namespace
}  // namespace lamplighter
