// What the panel says of each budget.
#include "editor/budgets/budget_costs.h"

#include "renderer/registry/registry.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

TEST(BudgetCosts, EveryBudgetHasOne) {
  for (const MethodInfo& method : methods()) {
    for (const ParameterSpec& spec : method.parameters) {
      const auto cost = costOf(spec.name, {}, {}, {});
      EXPECT_EQ(cost.has_value(), spec.group == ParameterGroup::budgets) << spec.name;
      EXPECT_FALSE(cost && cost->buys.empty()) << spec.name;
    }
  }
}

TEST(BudgetCosts, AreMeansOverTheFramesThatDrewUponThem) {
  Timeline timeline;
  GiStats stats;
  stats.mapsRendered = 20;
  stats.stageSeconds = {{"shadow maps", 0.010}};
  timeline.add(1, 0.00, 0.02, stats);
  stats.mapsRendered = 30;
  stats.stageSeconds = {{"shadow maps", 0.020}};
  timeline.add(2, 0.02, 0.05, stats);
  timeline.add(3, 0.05, 0.06, {});  // at rest
  Settings settings;
  settings.set("map_resolution", 10);
  EXPECT_EQ(costOf("max_shadow_maps", timeline, {}, settings)->measured,
            "25 maps, 15 ms (600 \u00b5s each)");
  EXPECT_EQ(costOf("max_rays", timeline, {}, settings)->measured,
            "2500 rays, 15 ms (6 \u00b5s each)");
  EXPECT_EQ(costOf("max_paths", timeline, {}, settings)->measured, "idle");
  EXPECT_EQ(costOf("frame_time", timeline, {}, settings)->measured, "20 ms a frame, 30 ms at most");
}

TEST(BudgetCosts, MapsTakeTheMemoryThatTheyHave) {
  GiStats stats;
  stats.mapsHeld = 12;
  stats.memoryBytes["shadow maps"] = 3 << 20;
  EXPECT_EQ(costOf("map_memory", {}, stats, {})->measured, "12 maps, 3 MiB");
  stats.mapsWithoutRoom = 2;
  EXPECT_EQ(costOf("map_memory", {}, stats, {})->measured, "12 maps, 3 MiB, 2 without room");
}

TEST(BudgetCosts, SayWhatHasNoRoom) {
  GiStats stats;
  EXPECT_EQ(costOf("light_map_memory", {}, stats, {})->measured, "none");
  EXPECT_EQ(costOf("prt_memory", {}, stats, {})->measured, "none");
  stats.memoryBytes["light maps"] = 7 << 20;
  EXPECT_EQ(costOf("light_map_memory", {}, stats, {})->measured, "left out: no room for any");
  stats.lightMapTexel = 0.14142f;
  EXPECT_EQ(costOf("light_map_memory", {}, stats, {})->measured, "7 MiB, texels of 0.14 m");
  stats.memoryBytes["transfer"] = 3 << 19;
  EXPECT_EQ(costOf("prt_memory", {}, stats, {})->measured, "1.5 MiB");
  stats.transferObjectsWithoutRoom = 4;
  EXPECT_EQ(costOf("prt_memory", {}, stats, {})->measured, "1.5 MiB, 4 meshes without room");
}

}  // namespace
}  // namespace lamplighter
