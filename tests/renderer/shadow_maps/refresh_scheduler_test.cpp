#include "renderer/shadow_maps/refresh_scheduler.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

TEST(ChooseRefreshes, TakesTheHighestPriorityWithinTheBudget) {
  const std::vector<RefreshCandidate> waiting{
      {1, 1, {}}, {5, 1, {}}, {2, 3, {}}, {6, 1, {}}, {3, 2, {}}};
  EXPECT_EQ(chooseRefreshes(waiting, {3}),
            (std::vector<size_t>{2, 3, 4}));  // priorities 6, 6, 6, before 5
  EXPECT_EQ(chooseRefreshes(waiting, {99}), (std::vector<size_t>{2, 3, 4, 1, 0}));
  EXPECT_TRUE(chooseRefreshes(waiting, {0}).empty());
  EXPECT_TRUE(chooseRefreshes({}, {10}).empty());
}

// Bright maps become outdated in every frame. The dimmest map must be refreshed at some time.
TEST(ChooseRefreshes, EveryMapIsRefreshedAtSomeTime) {
  std::vector<RefreshCandidate> maps(20, {100.0f, 1, {}});
  maps[13].brightness = 2.0f;
  int frame = 1;
  for (;; ++frame) {
    ASSERT_LT(frame, 500);
    const std::vector<size_t> chosen = chooseRefreshes(maps, {5});
    ASSERT_EQ(chosen.size(), 5u);
    for (RefreshCandidate& m : maps) ++m.framesWaiting;
    if (std::find(chosen.begin(), chosen.end(), size_t{13}) != chosen.end()) break;
    for (const size_t i : chosen) maps[i].framesWaiting = 1;
  }
  EXPECT_GT(frame, 100);  // not before its priority justifies it
}

// No limit of any kind of work is exceeded, except that the first refresh is always done.
TEST(ChooseRefreshes, KeepsWithinEachKindOfWork) {
  const RefreshWork each{1, 700, 20000, 4096};
  const std::vector<RefreshCandidate> waiting(10, {1.0f, 1, each});
  const auto chosen = [&](const RefreshWork& limit) {
    return chooseRefreshes(waiting, {8, limit}).size();
  };
  EXPECT_EQ(chosen({kNoLimit, kNoLimit, kNoLimit, kNoLimit}), 8u);
  EXPECT_EQ(chosen({3, kNoLimit, kNoLimit, kNoLimit}), 3u);
  EXPECT_EQ(chosen({kNoLimit, 2100, kNoLimit, kNoLimit}), 3u);
  EXPECT_EQ(chosen({kNoLimit, kNoLimit, 59999, kNoLimit}), 2u);
  EXPECT_EQ(chosen({kNoLimit, kNoLimit, kNoLimit, 5 * 4096}), 5u);
  EXPECT_EQ(chosen({kNoLimit, 10, kNoLimit, 10}), 1u);
}

TEST(SeesMover, UnlessItStaysBehindTheLight) {
  const shared::Vpl down = test::makeVpl(vec3(0, 3, 0), vec3(0, -1, 0));
  const Bounds below{vec3(-1, 0, -1), vec3(1, 1, 1)}, above{vec3(-1, 4, -1), vec3(1, 5, 1)};
  const Bounds across{vec3(5, 2, 5), vec3(6, 4, 6)};
  EXPECT_TRUE(seesMover(down, below, below));
  EXPECT_TRUE(seesMover(down, below, above));
  EXPECT_TRUE(seesMover(down, above, below));
  EXPECT_TRUE(seesMover(down, across, across));
  EXPECT_FALSE(seesMover(down, above, above));
  EXPECT_FALSE(seesMover(down, above, Bounds()));
  const shared::Vpl sun = test::makeVpl(vec3(0), vec3(0, 1, 0), shared::kVplDirectional);
  EXPECT_TRUE(seesMover(sun, above, above));
  // For an oblique axis, the decisive corner of the box is not the lowest one.
  const shared::Vpl aslant = test::makeVpl(vec3(0), vec3(1, -1, 0));
  EXPECT_TRUE(seesMover(aslant, Bounds{vec3(-3, 1, 0), vec3(2, 3, 1)}, Bounds()));
  EXPECT_FALSE(seesMover(aslant, Bounds{vec3(-3, 1, 0), vec3(0.9f, 3, 1)}, Bounds()));
}

struct Movers : testing::Test {
  std::vector<MoverFinder::Mover> step() {
    const SceneChanges changes = first ? SceneChanges::all() : compare(before, scene);
    first = false;
    before = scene;
    return finder.update(render, update(render, scene, changes));
  }
  Scene scene, before;
  RenderScene render;
  MoverFinder finder;
  bool first = true;
};

TEST_F(Movers, AreMovedAddedAndRemovedObjectsOnly) {
  const NodeId a = test::addMesh(scene, test::boxMesh(vec3(1)), vec3(0));
  test::addMesh(scene, test::boxMesh(vec3(1)), vec3(3, 0, 0));
  EXPECT_EQ(step().size(), 2u);
  EXPECT_TRUE(step().empty());

  scene.find(a)->local.translation.y = 2.0f;
  auto movers = step();
  ASSERT_EQ(movers.size(), 1u);
  EXPECT_EQ(movers[0].before.min, vec3(-0.5f));
  EXPECT_EQ(movers[0].after.min, vec3(-0.5f, 1.5f, -0.5f));

  scene.find(a)->local.rotation = glm::angleAxis(0.5f * kPi, vec3(0, 1, 0));
  EXPECT_EQ(step().size(), 1u);  // the bounds of the cube are the same, but it has rotated

  const NodeId c = test::addMesh(scene, test::boxMesh(vec3(1)), vec3(9, 0, 0));
  movers = step();
  ASSERT_EQ(movers.size(), 1u);
  EXPECT_TRUE(movers[0].before.empty());
  EXPECT_EQ(movers[0].after.min.x, 8.5f);

  scene.find(a)->visible = false;
  scene.find(c)->local.translation.x = 20.0f;
  movers = step();
  ASSERT_EQ(movers.size(), 2u);
  EXPECT_TRUE(movers[0].after.empty());
  EXPECT_EQ(movers[1].before.min.x, 8.5f);
  EXPECT_EQ(movers[1].after.min.x, 19.5f);
}

TEST_F(Movers, IncludeObjectsWhoseMaterialBecomesTransparent) {
  const int material = test::addMaterial(scene, vec3(0.5f));
  test::addMesh(scene, test::boxMesh(vec3(1), material));
  step();
  scene.materials[material].baseColor.r = 0.1f;
  EXPECT_TRUE(step().empty());  // the shadow does not depend on the colour
  scene.materials[material].transmission = 1.0f;
  EXPECT_EQ(step().size(), 1u);
}

}  // namespace
}  // namespace lamplighter
