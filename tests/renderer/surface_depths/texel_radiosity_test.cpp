#include "renderer/surface_depths/texel_radiosity.h"

#include <functional>

#include <gtest/gtest.h>

#include "tests/support/scenes/scenes.h"
#include "tests/support/scenes/skies.h"

namespace lamplighter {
namespace {

// A floor with boxes under a sky and a lamp, with its texels.
struct LitFloor {
  Scene scene;
  NodeId lamp;
  std::vector<NodeId> boxes;
  RenderScene render;
  std::unique_ptr<RayCaster> rays;
  Services services;
  TexelRadiosity light;
  TexelRadiosityOptions options;

  explicit LitFloor(bool hasSky = true) {
    options.visibility = TexelVisibility::rays;
    options.linkError = 0.002f;
    test::addMesh(scene, test::squareMesh(8.0f, test::addMaterial(scene, vec3(0.7f))));
    const int red = test::addMaterial(scene, vec3(0.8f, 0.2f, 0.1f));
    for (const vec3& at :
         {vec3(-2.0f, 0.7f, 0.0f), vec3(1.0f, 0.6f, 1.5f), vec3(2.5f, 1.0f, -2.0f)})
      boxes.push_back(test::addMesh(scene, test::boxMesh(vec3(1.0f), red), at));
    lamp = test::addRectangleLight(scene, vec3(0.0f, 3.0f, 0.0f), vec2(1.0f), vec3(20.0f));
    if (hasSky) scene.sky = test::gradientSky();
    render = test::renderSceneOf(scene);
    rays = std::make_unique<RayCaster>(render);
    settle(test::everythingRebuilt());
  }
  // A frame.
  void update(const RenderSceneChanges& changes) {
    services.beginFrame(render, changes, *rays, {}, changes.rebuilt);
    light.outdate(changes);
    light.update(render, services, options, 20'000);
  }
  // Returns the number of segments of links that were tested.
  uint64_t settle(const RenderSceneChanges& changes) {
    update(changes);
    uint64_t tested = light.counts().links;
    for (int i = 0; i < 10'000 && !light.isDone(); ++i) {
      update({});
      tested += light.counts().links;
    }
    EXPECT_TRUE(light.isDone());
    return tested;
  }
  RenderSceneChanges edited(const std::function<void(Scene&)>& edit) {
    const Scene old = scene;
    edit(scene);
    const RenderSceneChanges changes = lamplighter::update(render, scene, compare(old, scene));
    rays->update(changes);
    return changes;
  }
  void move(NodeId node, const vec3& way) {
    update(edited([&](Scene& s) { s.find(node)->local.translation += way; }));
  }
  // What texels have in a scene that was never edited.
  std::vector<vec3> fresh() const {
    TexelRadiosity other;
    Services own;
    RenderSceneChanges changes = test::everythingRebuilt();
    while (changes.rebuilt || !other.isDone()) {
      own.beginFrame(render, changes, *rays, {}, changes.rebuilt);
      other.outdate(changes);
      other.update(render, own, options, 1'000'000'000);
      changes = {};
    }
    return other.irradiance();
  }
};

// While an object moves, pixels find their texels in its space.
TEST(TexelRadiosity, TexelsGoWithAnObjectThatMoves) {
  LitFloor floor;
  const vec3 corner = floor.render.positions[floor.render.objects[1].firstVertex];
  const vec3 own = floor.light.atlases()[1].toOwn(corner);
  const vec3 way(0.5f, 0.2f, -0.3f);
  floor.move(floor.boxes[0], way);
  EXPECT_FALSE(floor.light.isDone());
  EXPECT_LT(glm::distance(floor.light.atlases()[1].toOwn(corner + way), own), 1e-5f);
}

TEST(TexelRadiosity, MovesLeaveTheLightOfAFreshStart) {
  LitFloor floor;
  const std::vector<vec3> before = floor.light.irradiance();
  for (int i = 0; i < 3; ++i) floor.move(floor.boxes[0], vec3(0.2f, 0.0f, 0.13f));
  floor.settle({});
  EXPECT_NE(floor.light.irradiance(), before);
  EXPECT_EQ(floor.light.irradiance(), floor.fresh());
  // Another one, and the lamp, before the links of the last move are all found.
  floor.move(floor.boxes[1], vec3(-0.6f, 0.4f, 0.0f));
  floor.update({});
  floor.update({});
  EXPECT_FALSE(floor.light.isDone());
  floor.move(floor.boxes[2], vec3(-0.3f, 0.0f, 0.7f));
  floor.move(floor.lamp, vec3(0.4f, -0.5f, 0.0f));
  floor.settle({});
  EXPECT_EQ(floor.light.irradiance(), floor.fresh());
}

TEST(TexelRadiosity, ALampThatMovesLeavesTheLightOfAFreshStart) {
  LitFloor floor;
  // Light of the first is blocked by the second.
  const NodeId second =
      test::addRectangleLight(floor.scene, vec3(0.0f, 2.0f, 0.0f), vec2(1.5f), vec3(5.0f));
  floor.render = test::renderSceneOf(floor.scene);
  floor.rays = std::make_unique<RayCaster>(floor.render);
  floor.settle(test::everythingRebuilt());
  for (int i = 0; i < 3; ++i) floor.move(second, vec3(0.3f, 0.1f, 0.0f));
  floor.settle({});
  EXPECT_EQ(floor.light.irradiance(), floor.fresh());
}

TEST(TexelRadiosity, ALampThatComesAndGoesLeavesTheLightOfBefore) {
  LitFloor floor;
  const std::vector<vec3> before = floor.light.irradiance();
  // It blocks the light of the other one.
  NodeId second = kNoNode;
  floor.settle(floor.edited([&](Scene& s) {
    second = test::addRectangleLight(s, vec3(0.0f, 2.0f, 0.0f), vec2(1.5f), vec3(5.0f));
  }));
  EXPECT_EQ(floor.light.irradiance(), floor.fresh());
  floor.settle(floor.edited([&](Scene& s) { s.find(second)->visible = false; }));
  EXPECT_EQ(floor.light.irradiance(), before);
}

TEST(TexelRadiosity, ObjectsThatComeAndGoLeaveTheLightOfAFreshStart) {
  LitFloor floor;
  floor.settle(floor.edited([&](Scene& s) { s.find(floor.boxes[1])->visible = false; }));
  EXPECT_EQ(floor.light.irradiance(), floor.fresh());
  floor.settle(floor.edited([&](Scene& s) { s.find(floor.boxes[1])->visible = true; }));
  EXPECT_EQ(floor.light.irradiance(), floor.fresh());
}

TEST(TexelRadiosity, OnlySegmentsThatMeetAMovedObjectAreTracedAgain) {
  LitFloor floor(false);
  TexelRadiosity other;
  uint64_t all = 0;
  for (RenderSceneChanges changes = test::everythingRebuilt(); changes.rebuilt || !other.isDone();
       changes = {}) {
    floor.services.beginFrame(floor.render, changes, *floor.rays, {}, changes.rebuilt);
    other.outdate(changes);
    other.update(floor.render, floor.services, floor.options, 20'000);
    all += other.counts().links;
  }
  floor.move(floor.boxes[2], vec3(0.1f, 0.0f, 0.0f));
  const uint64_t again = floor.settle({});
  EXPECT_GT(again, 0u);
  EXPECT_LT(again, all / 3);
  // A move without effect on segments between other objects, far away.
  floor.move(floor.boxes[2], vec3(0.0f, 50.0f, 0.0f));
  floor.settle({});
  floor.move(floor.boxes[2], vec3(0.0f, 1.0f, 0.0f));
  EXPECT_LT(floor.settle({}), again);
}

}  // namespace
}  // namespace lamplighter
