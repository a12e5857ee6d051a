#include "renderer/sampling/directional_origins.h"

#include <gtest/gtest.h>

#include "renderer/base/low_discrepancy.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A large ground with one small box: sums of 1/pdf over samples must give areas.
TEST(DirectionalOrigins, ThePdfMatchesTheSamples) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(100.0f));
  test::addMesh(scene, test::boxMesh(vec3(1.0f)), vec3(20, 0.5f, -10));
  const RenderScene world = test::renderSceneOf(scene);
  const vec3 centre = world.bounds.centre();
  const float radius = world.bounds.radius();
  const DirectionalOrigins start(world, centre, radius);
  const vec3 towards = glm::normalize(vec3(0.3f, 1.0f, 0.2f));
  constexpr uint32_t n = 1u << 16;
  double whole = 0.0, nearBox = 0.0;
  int through = 0;
  const vec3 box(20, 0.5f, -10);
  for (uint32_t i = 0; i < n; ++i) {
    const auto p = start.sample(towards, sobol2(i, 1), sobol2(i, 2).x);
    ASSERT_GT(p.pdf, 0.0f);
    ASSERT_NEAR(glm::dot(p.position - centre, towards), 0.0f, 1e-3f);
    whole += 1.0 / static_cast<double>(p.pdf);
    const vec3 d = p.position - box;
    const vec3 across = d - glm::dot(d, towards) * towards;
    if (glm::dot(across, across) < 0.25f) {
      nearBox += 1.0 / static_cast<double>(p.pdf);
      ++through;
    }
  }
  EXPECT_NEAR(whole / n / static_cast<double>(kPi * radius * radius), 1.0, 0.02);
  EXPECT_NEAR(nearBox / n / (static_cast<double>(kPi) * 0.25), 1.0, 0.02);
  EXPECT_GT(through, static_cast<int>(n / 10)) << "most samples must go to the small box";
}

}  // namespace
}  // namespace lamplighter
