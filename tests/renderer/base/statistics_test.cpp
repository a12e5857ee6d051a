// Statistics that are declared as data.
#include "renderer/base/statistics.h"

#include <set>

#include <gtest/gtest.h>

#include "renderer/methods/common_statistics.h"
#include "renderer/registry/registry.h"

namespace lamplighter {
namespace {

// Statistics of a method that exists only in this test.
struct ProbeStats : GiStats {
  int probes = 0, waiting = 0, oldest = 0;
  uint64_t bytes = 0;
  float share = 0.0f, found = 100.0f;
};

const StatisticTable<ProbeStats>& probeStatistics() {
  using S = ProbeStats;
  static const StatisticTable<S> table{
      {&S::probes,
       {.name = "probes",
        .label = "Probes",
        .unit = "probes",
        .meaning = "Probes that were updated.",
        .kind = StatisticKind::work,
        .status = "{} probe(s)"}},
      {&S::waiting,
       {.name = "waiting",
        .label = "Waiting",
        .unit = "probes",
        .meaning = "Probes that wait.",
        .kind = StatisticKind::pending,
        .status = "{} waiting",
        .shownFrom = 0.0}},
      {&S::oldest,
       {.name = "oldest",
        .label = "Oldest",
        .unit = "frames",
        .meaning = "The longest wait.",
        .status = ", oldest {} frame(s)"}},
      {&S::bytes, {.name = "bytes", .label = "Memory", .unit = "bytes", .meaning = "Memory."}},
      {&S::share, {.name = "share", .label = "Share", .unit = "share", .meaning = "Done."}},
      {&S::found,
       {.name = "found",
        .label = "Found",
        .unit = "%",
        .meaning = "Found.",
        .status = "finding {}",
        .shownFrom = 0.0,
        .shownBelow = 100.0}},
      commonStatistics()};
  return table;
}

std::vector<std::string> textsOf(const ProbeStats& stats) {
  std::vector<std::string> texts;
  for (const StatusText& text : statusTexts(probeStatistics().of(stats)))
    texts.push_back(text.text);
  return texts;
}

using Texts = std::vector<std::string>;

TEST(Statistics, AreFoundByName) {
  ProbeStats stats;
  stats.probes = 7;
  stats.raysTraced = 5'000'000'000;
  stats.framesUntilSettled = 3;
  const GiStats out = published(stats, probeStatistics());
  EXPECT_EQ(out.framesUntilSettled, 3);
  EXPECT_EQ(out.of("probes"), 7.0);
  EXPECT_EQ(out.of("rays"), 5e9);
  EXPECT_FALSE(out.find("vpls"));
  EXPECT_THROW(out.of("vpls"), std::out_of_range);
  EXPECT_EQ(out.declared.size(), probeStatistics().specs().size());
  EXPECT_TRUE(probeStatistics().specs().front().isWhole);
}

TEST(Statistics, TheStatusLineListsThem) {
  ProbeStats stats;
  EXPECT_EQ(textsOf(stats), (Texts{"0 waiting"}));
  stats.found = 99.9f;
  EXPECT_EQ(textsOf(stats), (Texts{"0 waiting", "finding 99%"}));
  stats.found = 100.0f;
  stats.probes = 1;
  stats.samplesPerPixel = 1;
  EXPECT_EQ(textsOf(stats), (Texts{"1 probe", "0 waiting"}));
  stats.probes = 1234567;
  stats.waiting = 2;
  stats.oldest = 3;
  stats.samplesPerPixel = 4;
  EXPECT_EQ(textsOf(stats),
            (Texts{"1,234,567 probes", "2 waiting, oldest 3 frames", "4 samples per pixel"}));
  const std::vector<StatusText> texts = statusTexts(probeStatistics().of(stats));
  EXPECT_EQ(texts[1].name, "waiting");
  EXPECT_EQ(texts[1].meaning, "Probes that wait. The longest wait.");
  EXPECT_TRUE(texts[1].isPending);
  EXPECT_FALSE(texts[1].isZero);
}

TEST(Statistics, ValuesHaveTheirUnit) {
  const auto text = [](const char* name, double value) {
    for (const StatisticSpec& spec : probeStatistics().specs())
      if (spec.name == name) return valueText(spec, value);
    return std::string();
  };
  EXPECT_EQ(text("probes", 999.0), "999");
  EXPECT_EQ(text("probes", 1000.0), "1,000");
  EXPECT_EQ(text("bytes", 3 << 19), "1.5 MiB");
  EXPECT_EQ(text("share", 0.429), "42%");
}

TEST(Statistics, WorkIsSummedOverFrames) {
  std::vector<Statistic> total;
  ProbeStats stats;
  for (int i = 1; i <= 3; ++i) {
    stats.probes = i;
    stats.waiting = 10 - i;
    accumulate(total, probeStatistics().of(stats));
  }
  EXPECT_EQ(total[0].value, 6.0);
  EXPECT_EQ(total[1].value, 7.0);
}

TEST(Statistics, OfMethodsAreDeclaredCompletely) {
  for (const MethodInfo& method : methods()) {
    std::set<std::string> names;
    for (const StatisticSpec& spec : method.statistics) {
      EXPECT_TRUE(names.insert(spec.name).second) << spec.name;
      EXPECT_FALSE(spec.label.empty()) << spec.name;
      EXPECT_TRUE(spec.meaning.ends_with('.')) << spec.name;
      if (spec.budget.empty()) continue;
      EXPECT_TRUE(findParameter(method.parameters, spec.budget) || spec.name == "samples_per_pixel")
          << spec.budget;
      const bool isWork = spec.kind == StatisticKind::work;
      EXPECT_EQ(isWork, !spec.stages.empty()) << spec.name;
      EXPECT_EQ(isWork, spec.cost.empty()) << spec.name;
    }
    EXPECT_TRUE(names.contains("rays") && names.contains("samples_per_pixel")) << method.name;
  }
}

TEST(Statistics, EachStageOfAMethodIsDeclaredWholly) {
  for (const MethodInfo& method : methods()) {
    EXPECT_FALSE(method.stages.empty()) << method.name;
    std::set<std::string_view> names;
    for (const StageSpec& stage : method.stages) {
      EXPECT_TRUE(names.insert(stage.name).second) << stage.name;
      EXPECT_FALSE(stage.label.empty()) << stage.name;
      EXPECT_TRUE(stage.meaning.ends_with('.')) << stage.name;
    }
    for (const StatisticSpec& spec : method.statistics)
      for (const StageSpec& stage : spec.stages)
        EXPECT_TRUE(names.contains(stage.name)) << spec.name << ": " << stage.name;
  }
}

}  // namespace
}  // namespace lamplighter
