#include "renderer/methods/carrier_rule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

using testing::HasSubstr;

// A room of 96 m², 1,536 texels of 0.25 m.
Scene room() {
  Scene scene;
  test::addMesh(scene, test::roomMesh(vec3(4.0f), test::addMaterial(scene, vec3(0.7f))));
  test::addRectangleLight(scene, vec3(0.0f, 1.9f, 0.0f), vec2(1.0f), vec3(10.0f));
  return scene;
}

CarrierChoice chosen(const Scene& scene, float texel = 0.25f) {
  return carrierFor(test::renderSceneOf(scene), texel);
}

TEST(CarrierRule, LinksForRoomsOfLargeSurfaces) {
  const CarrierChoice choice = chosen(room());
  EXPECT_EQ(choice.carrier, BouncedCarrier::links);
  EXPECT_THAT(choice.reason, HasSubstr("1536 texels"));
}

TEST(CarrierRule, MeshesUnderASky) {
  Scene scene = room();
  scene.sky = vec3(1.0f);
  const CarrierChoice choice = chosen(scene);
  EXPECT_EQ(choice.carrier, BouncedCarrier::meshes);
  EXPECT_THAT(choice.reason, HasSubstr("sky"));
}

TEST(CarrierRule, MeshesWithGloss) {
  Scene scene = room();
  test::addMesh(scene, test::boxMesh(vec3(1.0f), test::addMaterial(scene, vec3(0.5f), 1.0f, 0.2f)));
  const CarrierChoice choice = chosen(scene);
  EXPECT_EQ(choice.carrier, BouncedCarrier::meshes);
  EXPECT_THAT(choice.reason, HasSubstr("glossy"));
}

TEST(CarrierRule, MeshesWhereTrianglesAreFinerThanTexels) {
  Scene scene = room();
  // 2 · 30 · 60 triangles on 3 m².
  test::addMesh(scene, test::sphereMesh(0.5f, 30, 0.0f, test::addMaterial(scene, vec3(0.5f))));
  const CarrierChoice choice = chosen(scene);
  EXPECT_EQ(choice.carrier, BouncedCarrier::meshes);
  EXPECT_THAT(choice.reason, HasSubstr("finer"));
}

TEST(CarrierRule, MeshesWhereLinksWouldNeedManyTexels) {
  const CarrierChoice choice = chosen(room(), 0.09f);
  EXPECT_EQ(choice.carrier, BouncedCarrier::meshes);
  EXPECT_THAT(choice.reason, HasSubstr("links would need"));
}

TEST(CarrierRule, ImperfectShadowMapsInLevelsOfVeryManyTriangles) {
  Scene scene = room();
  // 2 · 400 · 800 triangles.
  test::addMesh(scene, test::sphereMesh(0.5f, 400, 0.0f, test::addMaterial(scene, vec3(0.5f))));
  const CarrierChoice choice = chosen(scene);
  EXPECT_EQ(choice.carrier, BouncedCarrier::imperfect);
  EXPECT_THAT(choice.reason, HasSubstr("many for meshes"));
  scene.sky = vec3(1.0f);
  EXPECT_EQ(chosen(scene).carrier, BouncedCarrier::meshes);
}

// Also under a sky; but not in rooms of few triangles, nor for lamps that shine black.
TEST(CarrierRule, ImperfectShadowMapsInLevelsOfManyLamps) {
  Scene scene = room();
  scene.sky = vec3(1.0f);
  std::vector<NodeId> lamps;
  for (int i = 0; i < 32; ++i)
    lamps.push_back(test::addRectangleLight(scene, vec3(0.0f, 1.9f, 0.1f * static_cast<float>(i)),
                                            vec2(0.05f), vec3(10.0f)));
  EXPECT_EQ(chosen(scene).carrier, BouncedCarrier::meshes);
  // 2 · 60 · 120 triangles.
  test::addMesh(scene, test::sphereMesh(0.5f, 60, 0.0f, test::addMaterial(scene, vec3(0.5f))));
  const CarrierChoice choice = chosen(scene);
  EXPECT_EQ(choice.carrier, BouncedCarrier::imperfect);
  EXPECT_THAT(choice.reason, HasSubstr("33 lamps"));
  scene.find(lamps.front())->area->radiance = vec3(0.0f);
  EXPECT_EQ(chosen(scene).carrier, BouncedCarrier::meshes);
}

}  // namespace
}  // namespace lamplighter
