// The unit of length that suits a level.
#include "renderer/sampling/scene_unit.h"

#include <gtest/gtest.h>

#include "tests/support/scenes/scaled_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

TEST(UnitFor, LevelsOfOrdinarySizeAreInMetres) {
  for (const float spacing : {0.07f, 1.0f, 5.0f, 100.0f})
    EXPECT_EQ(unitFor({spacing, spacing}), 1.0f) << spacing;
}

TEST(UnitFor, BothSpacingsMustBeUnusual) {
  EXPECT_EQ(unitFor({4.0f, 2000.0f}), 1.0f);  // a room below a dome, or on a plain
  EXPECT_EQ(unitFor({0.01f, 3.0f}), 1.0f);    // a room with a statue of many triangles
  EXPECT_EQ(unitFor({500.0f, 2000.0f}), 1024.0f);
  EXPECT_EQ(unitFor({500.0f, 0.0f}), 1024.0f);  // few rays from the plain hit anything
}

TEST(UnitFor, RoomsInOtherUnitsAreAsLargeAsInMetres) {
  const float room = 2.0f;
  const auto inUnits = [&](float metres) {
    const float spacing = room / metres;
    return spacing / unitFor({spacing, spacing});
  };
  EXPECT_NEAR(inUnits(0.001f), room, 0.1f * room);  // millimetres
  EXPECT_NEAR(inUnits(100.0f), room, 0.5f * room);  // hundreds of metres
  EXPECT_NEAR(inUnits(1000.0f), room, 0.1f * room);
  for (int i = -12; i <= 12; i += 3) {
    const float size = inUnits(std::pow(10.0f, static_cast<float>(i)));
    EXPECT_GE(size, 1.0f / 64) << i;
    EXPECT_LT(size, 128.0f) << i;
  }
}

TEST(UnitFor, WithoutSurfacesItIsAMetre) { EXPECT_EQ(unitFor({0.0f, 0.0f}), 1.0f); }

Spacing spacingOf(const Scene& scene, float unit = 1.0f) {
  RenderScene world;
  RenderSceneChanges changes = update(world, scene, SceneChanges::all());
  if (unit != 1.0f) changes = setUnit(world, scene, unit);
  const RayCaster rays(world);
  return SceneSpacing().update(world, rays, changes);
}

TEST(SceneSpacing, ScalesWithTheLevelInEachUnit) {
  const Scene room = test::roomOfAllLights();
  const Spacing metres = spacingOf(room);
  EXPECT_GT(metres.ofTriangles, 0.25f);
  EXPECT_LT(metres.ofArea, 6.0f);
  for (const float factor : {0x1p-10f, 0x1p10f})
    for (const float unit : {1.0f, factor}) {
      const Spacing other = spacingOf(test::scaledScene(room, factor), unit);
      EXPECT_EQ(other.ofTriangles, factor * metres.ofTriangles);
      EXPECT_EQ(other.ofArea, factor * metres.ofArea);
    }
}

TEST(SceneSpacing, IsThatOfAClosedForm) {
  // Cosine-distributed rays between the insides of a sphere have lengths 2r√u: the upper quartile
  // is 2r√(3/4). Those outwards hit nothing.
  Scene scene;
  test::addMesh(scene, test::sphereMesh(4.0f, 48));
  const Spacing spacing = spacingOf(scene);
  EXPECT_NEAR(spacing.ofArea, 8.0f * std::sqrt(0.75f), 0.5f);
  EXPECT_NEAR(spacing.ofTriangles, 8.0f * std::sqrt(0.75f), 0.5f);
}

// Hidden and deleted objects leave empty places in a scene that is edited.
TEST(SceneSpacing, IsThatOfAFreshStartAfterObjectsAreHidden) {
  const Scene room = test::roomOfAllLights();
  RenderScene world;
  update(world, room, SceneChanges::all());
  RayCaster rays(world);
  SceneSpacing kept;
  kept.update(world, rays, test::everythingRebuilt());
  int hidden = 0;
  for (size_t i = 0; i < room.nodes.size(); ++i) {
    if (room.nodes[i].mesh == kNone) continue;
    Scene without = room;
    without.nodes[i].visible = false;
    for (const Scene* scene : std::initializer_list<const Scene*>{&without, &room}) {
      const RenderSceneChanges changes =
          update(world, *scene, compare(scene == &room ? without : room, *scene));
      EXPECT_FALSE(changes.rebuilt);
      rays.update(changes);
      const Spacing now = kept.update(world, rays, changes), fresh = spacingOf(*scene);
      EXPECT_EQ(now.ofTriangles, fresh.ofTriangles) << i;
      EXPECT_EQ(now.ofArea, fresh.ofArea) << i;
    }
    ++hidden;
  }
  EXPECT_GT(hidden, 1);
}

}  // namespace
}  // namespace lamplighter
