#include "renderer/bake/gathered_light.h"

#include <cmath>

#include <gtest/gtest.h>

#include "renderer/base/random.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

struct Gathered {
  RenderScene render;
  std::unique_ptr<RayCaster> rays;
  LightSet lights;
  std::optional<DirectLight> direct;
  std::optional<GatheredLight> light;

  Gathered(const Scene& scene, TexelVisibility visibility, int bounces) {
    render = test::renderSceneOf(scene);
    rays = std::make_unique<RayCaster>(render);
    lights = LightSet(render);
    direct.emplace(render, *rays, lights, DirectLight::Options{1024, 32, 1});
    TexelRadiosityOptions options;
    options.visibility = visibility;
    options.bounces = bounces;
    light.emplace(render, *rays, *direct, options);
  }
  // At a random point of an object.
  vec3 at(uint32_t object, uint32_t number) const {
    const auto random = [&](uint32_t set) {
      return static_cast<float>(hash4(number, object, 0, set) >> 8) / 16777216.0f;
    };
    const uint32_t triangle = number % render.objects[object].triangleCount();
    const float u = random(1), v = random(2) * (1.0f - u);
    const SurfaceSpot spot = spotAt(render, object, {triangle, u, v});
    return light->irradiance(object, triangle,
                             {spot.position, spot.geometricNormal, spot.normal, 0});
  }
};

Scene litRoomWithBox() {
  Scene scene;
  test::addMesh(scene, test::roomMesh(vec3(4, 3, 4), test::addMaterial(scene, vec3(0.7f))));
  test::addMesh(scene, test::boxMesh(vec3(1), test::addMaterial(scene, vec3(0.5f, 0.3f, 0.1f))),
                vec3(0.3f, -0.9f, 0.2f));
  test::addRectangleLight(scene, vec3(-0.5f, 1.4f, 0), vec2(1), vec3(10));
  return scene;
}

// In a closed room of one albedo ρ that emits L everywhere, bounced light is π L (ρ + … + ρⁿ), also
// in corners and between texels.
TEST(GatheredLight, OfAFurnaceIsAGeometricSeriesEverywhere) {
  Scene scene;
  test::addMesh(scene,
                test::roomMesh(vec3(4, 3, 4), test::addMaterial(scene, vec3(0.7f), vec3(1.0f))));
  float expected = 0.0f;
  for (int bounces = 0; bounces <= 3; ++bounces) {
    const Gathered room(scene, TexelVisibility::rays, bounces);
    for (uint32_t i = 0; i < 400; ++i)
      ASSERT_NEAR(room.at(0, i).g, expected, 0.015f * expected) << bounces << ' ' << i;
    expected += kPi * std::pow(0.7f, static_cast<float>(bounces + 1));
  }
}

// There the depths of the sender answer.
TEST(GatheredLight, ByDepthsIsNearThatByRays) {
  const Scene scene = litRoomWithBox();
  const Gathered stored(scene, TexelVisibility::stored, 2), traced(scene, TexelVisibility::rays, 2);
  double squares = 0.0, mean = 0.0;
  constexpr uint32_t kPoints = 1000;
  for (uint32_t i = 0; i < kPoints; ++i) {
    const vec3 a = stored.at(i % 2, i), b = traced.at(i % 2, i);
    squares += std::pow(static_cast<double>(a.g - b.g), 2.0) / kPoints;
    mean += static_cast<double>(b.g) / kPoints;
  }
  RecordProperty("relRmse", std::to_string(std::sqrt(squares) / mean));
  EXPECT_LT(std::sqrt(squares), 0.05 * mean);
}

// The ceiling behind a lamp that nearly touches it.
TEST(GatheredLight, IsBlockedByAreaLights) {
  Scene scene;
  test::addMesh(scene, test::roomMesh(vec3(4, 3, 4), test::addMaterial(scene, vec3(0.7f))));
  test::addRectangleLight(scene, vec3(0, 1.495f, 0), vec2(1), vec3(10));
  const Gathered room(scene, TexelVisibility::rays, 2);
  const auto ceiling = [&](const vec3& place) {
    for (uint32_t triangle = 0; triangle < room.render.objects[0].triangleCount(); ++triangle) {
      const SurfaceSpot spot = spotAt(room.render, 0, {triangle, 1.0f / 3, 1.0f / 3});
      if (spot.geometricNormal.y < -0.9f)
        return room.light->irradiance(0, triangle,
                                      {place, spot.geometricNormal, spot.geometricNormal, 0});
    }
    return vec3(-1.0f);
  };
  EXPECT_GT(ceiling(vec3(1.5f, 1.5f, 0)).g, 0.5f);
  EXPECT_LT(ceiling(vec3(0.1f, 1.5f, 0.1f)).g, 0.02f);
}

}  // namespace
}  // namespace lamplighter
