// All memory limits as one.
#include "editor/budgets/memory_limit.h"

#include "renderer/methods/many_lights/statistics.h"
#include "renderer/registry/registry.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

const MethodInfo& manyLights() { return findMethod("many_lights"); }

TEST(MemoryLimit, IsTheSumOfAllLimits) {
  int sum = 0;
  for (const ParameterSpec& spec : manyLights().parameters)
    if (spec.name.ends_with("_memory")) sum += std::get<int>(spec.defaultValue);
  EXPECT_GT(sum, 1000);
  EXPECT_EQ(memoryLimit(manyLights(), {}), sum);
  Settings settings;
  settings.set("map_memory", 512 + 100);
  EXPECT_EQ(memoryLimit(manyLights(), settings), sum + 100);
}

TEST(MemoryLimit, KeepsTheProportionsOfTheDefaults) {
  const int all = memoryLimit(manyLights(), {});
  Settings settings;
  settings.set("map_memory", 7);  // of no matter once the sum is set
  settings.set("bounces", 3);
  settings = withMemoryLimit(manyLights(), settings, 2 * all);
  EXPECT_EQ(memoryLimit(manyLights(), settings), 2 * all);
  EXPECT_EQ(std::get<int>(settings.values().at("map_memory")), 1024);
  EXPECT_EQ(std::get<int>(settings.values().at("link_memory")), 128);
  EXPECT_EQ(std::get<int>(settings.values().at("bounces")), 3);
  // That of the defaults leaves nothing set.
  settings = withMemoryLimit(manyLights(), settings, all);
  EXPECT_EQ(settings.values().size(), 1u);
}

TEST(MemoryLimit, StaysWithinTheRangesOfAllMethods) {
  for (const MethodInfo& method : methods()) {
    SCOPED_TRACE(method.name);
    const auto [least, most] = memoryRange(method);
    if (most == 0) {
      EXPECT_EQ(memoryLimit(method, {}), 0);
      continue;
    }
    EXPECT_LT(least, memoryLimit(method, {}));
    for (const int total : {least, (least + most) / 2, most}) {
      const Settings settings = withMemoryLimit(method, {}, total);
      EXPECT_NEAR(memoryLimit(method, settings), total, 4) << "each limit is rounded";
      for (const auto& [name, value] : settings.values()) {
        const ParameterSpec& spec = *findParameter(method.parameters, name);
        EXPECT_NO_THROW(Settings::parse(spec, Settings::format(value))) << name;
        EXPECT_GE(std::get<int>(value), 1) << name;
      }
    }
  }
}

// Not what a part that was left out would need.
TEST(MemoryLimit, CountsWhatIsUsed) {
  ManyLightsStats stats;
  stats.mapBytes = 3 << 20;
  stats.shareBytes = 2 << 20;
  stats.visibilityBytesNeeded = 100 << 20;
  EXPECT_EQ(memoryUsed(manyLights(), published(stats, manyLightsStatistics())), 5u << 20);
}

class MemoryAction : public test::SessionFixture {};

TEST_F(MemoryAction, IsOneStepWithUndo) {
  const uint64_t before = hash();
  ASSERT_TRUE(session_.runAction("render.memory 1000")) << session_.status();
  EXPECT_NEAR(memoryLimit(manyLights(), session_.document().render.values), 1000, 4);
  session_.undo();
  EXPECT_EQ(hash(), before);
  EXPECT_FALSE(session_.runAction("render.memory 0"));
  EXPECT_FALSE(session_.runAction("render.memory much"));
  EXPECT_EQ(hash(), before);
}

}  // namespace
}  // namespace lamplighter
