// Masks on lights against rays and closed forms.
#include "renderer/surface_light/visible_places.h"

#include <bit>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/base/random.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/surface_light/blockers.h"
#include "renderer/surface_light/form_factor.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

float random(uint32_t i, uint32_t dimension) { return toUnitFloat(hash4(i, dimension, 5, 77)); }

FlatLight rectangle(int side) {
  Scene scene;
  test::addRectangleLight(scene, vec3(0.2f, 2.0f, 0.1f), vec2(1.2f, 0.7f), vec3(1.0f));
  const auto light = flatLightOf(test::renderSceneOf(scene), 0, side);
  EXPECT_TRUE(light.has_value());
  return *light;
}

// Whether the segment meets the triangle.
bool isBetween(const vec3& from, const vec3& to, const std::array<vec3, 3>& t) {
  const glm::dvec3 a(t[0]), ab = glm::dvec3(t[1]) - a, ac = glm::dvec3(t[2]) - a;
  const glm::dvec3 d = glm::dvec3(to) - glm::dvec3(from), n = glm::cross(ab, ac);
  const double along = glm::dot(d, n);
  if (along == 0.0) return false;
  const glm::dvec3 side = glm::cross(a - glm::dvec3(from), d);
  const double u = glm::dot(side, ac) / along, v = -glm::dot(side, ab) / along;
  const double at = glm::dot(a - glm::dvec3(from), n) / along;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && at > 1e-3 && at < 1.0 - 1e-4;
}

TEST(VisiblePlaces, IsWhatRaysToTheSamePlacesSeeButForEdges) {
  const FlatLight light = rectangle(64);
  int different = 0, hidden = 0;
  for (uint32_t i = 0; i < 200; ++i) {
    const vec3 x(2.0f * random(i, 0) - 1.0f, 0.5f * random(i, 1), 2.0f * random(i, 2) - 1.0f);
    std::array<vec3, 3> t;
    for (uint32_t c = 0; c < 3; ++c)
      t[c] = vec3(2.0f * random(i, 10 + 3 * c) - 1.0f, 2.6f * random(i, 11 + 3 * c) - 0.1f,
                  2.0f * random(i, 12 + 3 * c) - 1.0f);
    VisiblePlaces mask(light, x);
    mask.block(t[0], t[1], t[2]);
    const auto hides = [&](float column, float row) {
      return isBetween(x, light.place(column, row), t);
    };
    for (int row = 0; row < 64; ++row) {
      for (int column = 0; column < 64; ++column) {
        const float c = static_cast<float>(column) + 0.5f, r = static_cast<float>(row) + 0.5f;
        const bool expected = hides(c, r);
        hidden += expected;
        if (mask.isVisible(column, row) != expected) continue;
        ++different;
        // Then an edge is less than a hundredth of a place away.
        const bool isEdge = hides(c - 0.01f, r) != expected || hides(c + 0.01f, r) != expected ||
                            hides(c, r - 0.01f) != expected || hides(c, r + 0.01f) != expected;
        EXPECT_TRUE(isEdge) << i << " " << column << " " << row;
      }
    }
  }
  EXPECT_GT(hidden, 10000);
  EXPECT_LT(different, hidden / 1000);
}

// Relative errors of factors behind a half-plane, whose edge has many positions.
double meanErrorOfHalfPlane(int side, double* largest) {
  const FlatLight light = rectangle(side);
  const std::array<vec3, 4> whole{light.origin, light.origin + light.across,
                                  light.origin + light.across + light.up, light.origin + light.up};
  const vec3 x(0.1f, 0.0f, 0.05f), n(0, 1, 0);
  double sum = 0.0;
  int count = 0;
  for (float edge = -0.12f; edge < 0.3f; edge += 0.00317f) {
    // Everything with a larger x at the height 1 is covered.
    VisiblePlaces mask(light, x);
    const vec3 a(edge, 1.0f, -9.0f), b(edge + 0.05f, 1.0f, 9.0f);
    mask.block(a, vec3(20.0f, 1.0f, 0.0f), b);
    mask.block(a, vec3(20.0f, 1.0f, -9.0f), vec3(20.0f, 1.0f, 0.0f));
    mask.block(b, vec3(20.0f, 1.0f, 0.0f), vec3(20.0f, 1.0f, 9.0f));
    const double found = static_cast<double>(polygonFactor(x, n, whole)) * mask.visibleShare(n);
    // The light clipped at the plane through x and the edge.
    vec3 plane = glm::cross(a - x, b - x);
    if (glm::dot(plane, vec3(-1, 0, 0)) < 0.0f) plane = -plane;
    std::vector<vec3> clipped;
    for (size_t i = 0; i < 4; ++i) {
      const vec3 &p = whole[i], &q = whole[(i + 1) % 4];
      const float dp = glm::dot(p - x, plane), dq = glm::dot(q - x, plane);
      if (dp >= 0.0f) clipped.push_back(p);
      if (dp * dq < 0.0f) clipped.push_back(p + (q - p) * (dp / (dp - dq)));
    }
    if (clipped.size() < 3) continue;
    const double expected = polygonFactor(x, n, clipped);
    const double error = std::abs(found - expected) / polygonFactor(x, n, whole);
    if (largest) *largest = std::max(*largest, error);
    sum += error;
    ++count;
  }
  EXPECT_GT(count, 50);
  return sum / count;
}

TEST(VisiblePlaces, FactorBehindAHalfPlaneIsThatOfTheClippedPolygon) {
  double largest = 0.0;
  const double fine = meanErrorOfHalfPlane(64, &largest);
  EXPECT_LT(largest, 0.01);
  const double middle = meanErrorOfHalfPlane(32, nullptr);
  const double coarse = meanErrorOfHalfPlane(16, nullptr);
  RecordProperty(
      "errors", std::to_string(coarse) + " " + std::to_string(middle) + " " + std::to_string(fine));
  // The error falls at least with the number of places along a side.
  EXPECT_GT(coarse, 1.6 * middle);
  EXPECT_GT(middle, 1.6 * fine);
}

TEST(VisiblePlaces, CoversTheShapeOfALight) {
  Scene scene;
  const NodeId id = test::addNode(scene, "disk");
  scene.find(id)->area = AreaLight{AreaShape::disk, vec3(1.0f), vec2(2.0f)};
  const auto disk = flatLightOf(test::renderSceneOf(scene), 0, 64);
  ASSERT_TRUE(disk.has_value());
  int places = 0;
  for (const uint64_t row : disk->shape) places += std::popcount(row);
  EXPECT_NEAR(places / 4096.0, kPi / 4.0, 0.02);
  scene.find(id)->area->shape = AreaShape::sphere;
  EXPECT_FALSE(flatLightOf(test::renderSceneOf(scene), 0, 64).has_value());
}

TEST(Blockers, NoneMeansThatNoRayIsBlocked) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(6.0f));
  for (uint32_t i = 0; i < 12; ++i)
    test::addMesh(
        scene, test::boxMesh(vec3(0.1f + 0.3f * random(i, 40))),
        vec3(4.0f * random(i, 41) - 2.0f, 1.6f * random(i, 42), 4.0f * random(i, 43) - 2.0f));
  test::addRectangleLight(scene, vec3(0.2f, 2.0f, 0.1f), vec2(1.2f, 0.7f), vec3(1.0f));
  const RenderScene render = test::renderSceneOf(scene);
  const RayCaster rays(render);
  const auto light = flatLightOf(render, static_cast<uint32_t>(render.objects.size() - 1), 64);
  ASSERT_TRUE(light.has_value());
  Blockers blockers;
  blockers.update(render, true, {});
  int tested = 0, open = 0, wrong = 0, same = 0;
  std::vector<std::array<vec3, 3>> triangles;
  for (uint32_t i = 0; i < 400; ++i) {
    const vec3 x(5.0f * random(i, 50) - 2.5f, 0.0f, 5.0f * random(i, 51) - 2.5f);
    const auto found = blockers.find(render, *light, x, vec3(0, 1, 0), triangles);
    if (found == Blockers::Found::tooMany) continue;
    ++tested;
    VisiblePlaces mask(*light, x);
    for (const auto& t : triangles) mask.block(t[0], t[1], t[2]);
    open += found == Blockers::Found::none;
    for (int k = 0; k < 16; ++k) {
      const int column = 4 + 16 * (k % 4), row = 4 + 16 * (k / 4);
      const vec3 to =
          light->place(static_cast<float>(column) + 0.5f, static_cast<float>(row) + 0.5f);
      const vec3 from = x + vec3(0, rayEpsilon(x), 0);
      const bool isBlocked = rays.occluded({from, 0.0f, to + vec3(0, -1e-4f, 0) - from, 1.0f});
      wrong += found == Blockers::Found::none && isBlocked;
      same += isBlocked != mask.isVisible(column, row);
    }
  }
  EXPECT_GT(open, 20);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(tested, 300);
  EXPECT_GT(same, tested * 16 * 995 / 1000);
}

}  // namespace
}  // namespace lamplighter
