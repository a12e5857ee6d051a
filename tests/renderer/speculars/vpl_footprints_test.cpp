#include "renderer/sampling/vpl_footprints.h"

#include <gtest/gtest.h>

#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

struct Footprints {
  Footprints(const Scene& scene, int total, int bounces) {
    update(world, scene, SceneChanges::all());
    const RayCaster rays(world);
    const LightSet lights(world);
    VplCounts counts;
    counts.total = total;
    counts.bounces = bounces;
    VplSet set = generateVpls(world, rays, lights, counts);
    findFootprints(lights, set.vpls);
    vpls = std::move(set.vpls);
  }
  float sum(bool indirect) const {
    float sum = 0.0f;
    for (const SceneVpl& v : vpls)
      if ((v.id.bounce > 0) == indirect) sum += v.vpl.footprint.x;
    return sum;
  }
  RenderScene world;
  std::vector<SceneVpl> vpls;
};

Scene room() {
  Scene scene;
  const int white = test::addMaterial(scene, vec3(0.7f));
  test::addMesh(scene, test::roomMesh(vec3(4, 3, 5), white));
  test::addRectangleLight(scene, vec3(0, 1.4f, 0), vec2(1.0f, 0.8f), vec3(5.0f));
  return scene;
}

TEST(VplFootprints, OfALightSumToItsArea) {
  const Footprints f(room(), 60, 0);
  EXPECT_NEAR(f.sum(false), 0.8f, 1e-4f);
}

TEST(VplFootprints, OfTheSkySumToTheWholeSphere) {
  Scene scene = room();
  scene.nodes.pop_back();
  scene.sky = vec3(1.0f);
  const Footprints f(scene, 50, 0);
  EXPECT_NEAR(f.sum(false), 4.0f * kPi, 1e-3f);
}

// Their sum is about the area of the walls, 94 m²: discs of neighbours overlap and extend around
// corners.
TEST(VplFootprints, OfIndirectLightSumToAboutTheAreaOfTheWalls) {
  for (const int total : {200, 1000, 4000}) {
    const Footprints f(room(), total, 1);
    EXPECT_GT(f.sum(true), 50.0f) << total;
    EXPECT_LT(f.sum(true), 150.0f) << total;
  }
}

TEST(VplFootprints, OfPointLightsAreZero) {
  Scene scene = room();
  scene.nodes.pop_back();
  Node& lamp = scene.nodes.emplace_back();
  lamp.id = scene.nextId++;
  lamp.punctual = PunctualLight{};
  const Footprints f(scene, 10, 0);
  ASSERT_EQ(f.vpls.size(), 2u);
  EXPECT_EQ(f.sum(false), 0.0f);
}

}  // namespace
}  // namespace lamplighter
