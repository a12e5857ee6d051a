// Clusters of lights save tests and do not change any entry.
#include "renderer/visibility/light_clusters.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "renderer/visibility/visibility_database.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/room_lights.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

void fill(VisibilityDatabase& database, const RenderScene& scene,
          std::span<const shared::Vpl> lights) {
  database.setScene(scene, test::everythingRebuilt());
  database.setLights(scene, lights);
}

// With `vpls` light samples of the scene; 0: with 300 random ones.
void compareStates(const Scene& from, int vpls) {
  const RenderScene scene = test::renderSceneOf(from);
  const std::vector<shared::Vpl> lights =
      vpls > 0 ? test::lightsOf(scene, {vpls, 0.5f, 2, 1}) : test::randomVpls(300, 7);
  VisibilityDatabase with, without;
  without.useClusters(false);
  fill(with, scene, lights);
  fill(without, scene, lights);
  size_t differ = 0, entries = 0;
  for (uint32_t object = 0; object < with.objects(); ++object) {
    for (size_t p = 0; p < with.patches(object).patches.size(); ++p) {
      const int patch = static_cast<int>(p);
      EXPECT_EQ(with.isDivided(object, patch), without.isDivided(object, patch));
      for (int slot = 0; slot < static_cast<int>(lights.size()); ++slot, ++entries)
        differ += with.state(object, patch, slot) != without.state(object, patch, slot);
    }
  }
  EXPECT_GT(entries, 1000u);
  EXPECT_EQ(differ, 0u) << "of " << entries;
}

TEST(LightClusters, StatesAreTheSameInRandomScenes) {
  for (uint32_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    compareStates(test::randomBoxes(4 + static_cast<int>(5 * seed), seed), 0);
  }
}

TEST(LightClusters, StatesAreTheSameInRooms) {
  for (const char* room : {"pillar_room", "area_light_room", "table_room"}) {
    SCOPED_TRACE(room);
    compareStates(test::loadAsset(room), 400);
  }
}

TEST(LightClusters, ContainEachLightOnceAndAreSmall) {
  const RenderScene scene = test::renderSceneOf(test::loadAsset("pillar_room"));
  std::vector<shared::Vpl> lights = test::lightsOf(scene, {500, 0.5f, 2, 1});
  lights[3] = {};  // an empty slot
  lights[5].position.w = shared::kVplDirectional;
  const LightClusters clusters = clusterLights(lights);
  EXPECT_EQ(std::set<int>(clusters.order.begin(), clusters.order.end()).size(), lights.size());
  EXPECT_EQ(clusters.order.size(), lights.size());
  EXPECT_EQ(clusters.clusterOf[3], -1);
  EXPECT_EQ(clusters.clusterOf[5], -1);
  std::map<int, Bounds> boxes;
  std::map<int, int> counts;
  for (size_t i = 0; i < lights.size(); ++i) {
    if (clusters.clusterOf[i] < 0) continue;
    boxes[clusters.clusterOf[i]].add(vec3(lights[i].position));
    ++counts[clusters.clusterOf[i]];
  }
  for (const auto& [cluster, count] : counts) {
    EXPECT_LE(count, 16);
    const vec3 extent = boxes[cluster].extent();
    EXPECT_LE(std::max({extent.x, extent.y, extent.z}), 2.0f);
  }
  EXPECT_LT(counts.size(), lights.size() / 4);
}

}  // namespace
}  // namespace lamplighter
