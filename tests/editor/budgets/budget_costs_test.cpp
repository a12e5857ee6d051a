// The texts that the panel shows for each budget.
#include "editor/budgets/budget_costs.h"

#include "renderer/methods/many_lights/stages.h"
#include "renderer/methods/many_lights/statistics.h"
#include "renderer/registry/registry.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

const MethodInfo& manyLights() { return findMethod("many_lights"); }

std::string measured(const char* budget, const Timeline& timeline, const ManyLightsStats& now) {
  return costOf(*findParameter(manyLights().parameters, budget), manyLights(), timeline,
                published(now, manyLightsStatistics()))
      ->measured;
}

TEST(BudgetCosts, EveryBudgetHasACost) {
  for (const MethodInfo& method : methods()) {
    for (const ParameterSpec& spec : method.parameters) {
      const auto cost = costOf(spec, method, {}, {});
      EXPECT_EQ(cost.has_value(), spec.group == ParameterGroup::budgets) << spec.name;
      EXPECT_FALSE(cost && cost->buys.empty()) << spec.name;
    }
  }
}

TEST(BudgetCosts, AreMeansOverTheFramesThatUsedTheBudget) {
  Timeline timeline;
  ManyLightsStats stats;
  const auto add = [&](uint32_t frame, double begin, double end) {
    timeline.add(frame, begin, end, published(stats, manyLightsStatistics()));
  };
  stats.mapsRendered = 20;
  stats.mapRays = 2000;
  stats.stageSeconds = {{kShadowMapsStage, 0.010}};
  add(1, 0.00, 0.02);
  stats.mapsRendered = 30;
  stats.mapRays = 3000;
  stats.stageSeconds = {{kShadowMapsStage, 0.020}};
  add(2, 0.02, 0.05);
  timeline.add(3, 0.05, 0.06, {});  // an idle frame
  EXPECT_EQ(measured("max_shadow_maps", timeline, {}), "25 maps, 15 ms (600 \u00b5s each)");
  EXPECT_EQ(measured("max_rays", timeline, {}), "2500 rays, 15 ms (6 \u00b5s each)");
  EXPECT_EQ(measured("max_paths", timeline, {}), "idle");
  EXPECT_EQ(measured("frame_time", timeline, {}), "20 ms per frame, 30 ms at most");
}

TEST(BudgetCosts, ShadowMapsShowTheirMemory) {
  ManyLightsStats stats;
  stats.mapsHeld = 12;
  stats.mapBytes = 3 << 20;
  EXPECT_EQ(measured("map_memory", {}, stats), "12 maps, 3 MiB");
  stats.mapsWithoutRoom = 2;
  EXPECT_EQ(measured("map_memory", {}, stats), "12 maps, 3 MiB, 2 without room");
}

TEST(BudgetCosts, SayWhatDoesNotFit) {
  ManyLightsStats stats;
  EXPECT_EQ(measured("light_map_memory", {}, stats), "none");
  EXPECT_EQ(measured("prt_memory", {}, stats), "none");
  EXPECT_EQ(measured("visibility_memory", {}, stats), "none");
  stats.visibilityBytesNeeded = 5 << 20;
  EXPECT_EQ(measured("visibility_memory", {}, stats), "left out: needs 5 MiB");
  stats.lightMapsWithoutRoom = true;
  EXPECT_EQ(measured("light_map_memory", {}, stats), "left out: no room for any");
  stats.lightMapsWithoutRoom = false;
  stats.lightMapBytes = 7 << 20;
  stats.lightMapTexel = 0.14142f;
  EXPECT_EQ(measured("light_map_memory", {}, stats), "7 MiB, texels of 0.14 m");
  stats.transferBytes = 3 << 19;
  EXPECT_EQ(measured("prt_memory", {}, stats), "1.5 MiB");
  stats.transferObjectsWithoutRoom = 4;
  EXPECT_EQ(measured("prt_memory", {}, stats), "1.5 MiB, 4 meshes without room");
}

}  // namespace
}  // namespace lamplighter
