// The timeline: what is kept of frames and how it is written.
#include "editor/timeline/timeline.h"

#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "renderer/base/error.h"
#include "renderer/methods/many_lights/stages.h"
#include "renderer/methods/many_lights/statistics.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

GiStats statsOf(double maps, double sums) {
  ManyLightsStats stats;
  stats.stageSeconds = {{kShadowMapsStage, maps}, {kLightSumsStage, sums}};
  stats.mapsRendered = 12;
  stats.vpls = 300;
  return published(stats, manyLightsStatistics());
}

TEST(Timeline, DividesAFrameIntoStagesAndTheRest) {
  Timeline timeline;
  timeline.add(7, 2.0, 2.050, statsOf(0.010, 0.025));
  ASSERT_EQ(timeline.frames().size(), 1u);
  const FrameTiming& f = timeline.frames().front();
  EXPECT_DOUBLE_EQ(f.stats.secondsOf(kShadowMapsStage), 0.010);
  EXPECT_DOUBLE_EQ(f.stats.secondsOf(kLightSumsStage), 0.025);
  EXPECT_NEAR(f.stats.secondsOf(kOtherStage), 0.015, 1e-9);
  double sum = 0.0;
  for (const auto& [stage, seconds] : f.stats.stageSeconds) sum += seconds;
  EXPECT_NEAR(sum, f.seconds(), 1e-9);
}

// Of methods that the timeline does not know, in declared order.
TEST(Timeline, ListsTheStagesOfItsFrames) {
  static constexpr StageSpec kGather{"gather", "Gather", "Gathering light."};
  static constexpr StageSpec kFilter{"filter", "Filter", "Filtering it."};
  Timeline timeline;
  EXPECT_EQ(timeline.stages(), (std::vector<StageSpec>{kOtherStage}));
  GiStats stats;
  stats.stageSeconds = {{kGather, 0.01}, {kFilter, 0.0}};
  timeline.add(1, 2.0, 2.1, stats);
  timeline.add(2, 2.1, 2.2, statsOf(0.01, 0.02));
  stats.stageSeconds = {{kGather, 0.03}, {kFilter, 0.02}};
  timeline.add(3, 2.2, 2.3, stats);
  EXPECT_EQ(timeline.stages(), (std::vector<StageSpec>{kGather, kFilter, kShadowMapsStage,
                                                       kLightSumsStage, kOtherStage}));
  EXPECT_DOUBLE_EQ(timeline.meanOf(kGather), 0.02);
  EXPECT_DOUBLE_EQ(timeline.meanOf(kFilter), 0.02);
  EXPECT_DOUBLE_EQ(timeline.meanOf(kPathsStage), 0.0);
}

TEST(Timeline, KeepsOnlyTheLastSeconds) {
  Timeline timeline;
  for (int i = 0; i < 300; ++i)
    timeline.add(static_cast<uint32_t>(i), 0.1 * i, 0.1 * i + 0.05, statsOf(0.01, 0.02));
  EXPECT_EQ(timeline.frames().back().frame, 299u);
  EXPECT_NEAR(timeline.frames().back().end - timeline.frames().front().end, 10.0, 0.11);
  for (int i = 0; i < 5000; ++i) timeline.add(0, 40.0 + 1e-4 * i, 40.0 + 1e-4 * i + 5e-5, {});
  EXPECT_EQ(timeline.frames().size(), 2000u);
  timeline.clear();
  timeline.add(1, 3.0, 3.0, {});  // without a clock
  EXPECT_TRUE(timeline.frames().empty());
}

TEST(Timeline, ATraceHasTheStagesWithinTheirFrame) {
  Timeline timeline;
  timeline.add(7, 2.0, 2.050, statsOf(0.010, 0.025));
  timeline.add(8, 2.1, 2.130, statsOf(0.005, 0.020));
  const auto trace = nlohmann::json::parse(chromeTrace(timeline));
  int frames = 0, stages = 0, counters = 0;
  double from = 0.0, to = 0.0;
  for (const auto& event : trace["traceEvents"]) {
    if (event["ph"] == "C") {
      ++counters;
      const bool isOfMaps = event["name"] == "maps_rendered";
      EXPECT_TRUE(!isOfMaps || event["args"]["count"] == 12);
    } else if (event["name"] == "frame") {
      ++frames;
      from = event["ts"];
      to = from + event["dur"].get<double>();
    } else {
      ++stages;
      EXPECT_GE(event["ts"].get<double>(), from - 1e-3);
      EXPECT_LE(event["ts"].get<double>() + event["dur"].get<double>(), to + 1e-3);
    }
  }
  EXPECT_EQ(frames, 2);
  EXPECT_EQ(stages, 6);
  EXPECT_EQ(counters, 2 * static_cast<int>(timeline.counters().size()));
}

TEST(Timeline, HasTheCountersOfTheMethodsOfItsFrames) {
  Timeline timeline;
  EXPECT_TRUE(timeline.counters().empty());
  timeline.add(1, 2.0, 2.1, statsOf(0.01, 0.02));
  timeline.add(2, 2.1, 2.2, published(GiStats(), commonStatistics()));
  std::vector<std::string> names;
  for (const StatisticSpec* counter : timeline.counters()) names.push_back(counter->name);
  EXPECT_EQ(names,
            (std::vector<std::string>{
                "vpls", "vpls_refreshed", "vpls_pending", "gl_waits", "gl_uploads", "maps_rendered",
                "maps_held", "visibility_tests", "light_map_texels", "paths_walked", "rays"}));
}

TEST(Timeline, ATableHasARowAFrame) {
  Timeline timeline;
  timeline.add(7, 2.0, 2.050, statsOf(0.010, 0.025));
  timeline.add(8, 2.1, 2.130, statsOf(0.005, 0.020));
  std::istringstream csv(timelineCsv(timeline));
  std::string head, first, second, more;
  std::getline(csv, head);
  std::getline(csv, first);
  std::getline(csv, second);
  EXPECT_FALSE(std::getline(csv, more));
  EXPECT_TRUE(head.starts_with("frame,begin_s,frame_ms,shadow_maps_ms,light_sums_ms,other_ms,"))
      << head;
  EXPECT_EQ(std::count(head.begin(), head.end(), ','), std::count(first.begin(), first.end(), ','));
  EXPECT_TRUE(first.starts_with("7,0.000000,50.0000,")) << first;
  EXPECT_TRUE(second.starts_with("8,0.100000,30.0000,")) << second;
}

class TimelineExport : public test::SessionFixture {
 protected:
  fs::path folder_ = fs::path(testing::TempDir()) / "lamplighter_timeline";
  void SetUp() override {
    SessionFixture::SetUp();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string action(const char* file) const {
    return "timeline.export " + (folder_ / file).string();
  }
};

TEST_F(TimelineExport, WritesBothFormatsAndReportsErrors) {
  EXPECT_FALSE(session_.runAction(action("a.json")));  // no frame was measured
  EXPECT_TRUE(session_.status().starts_with("timeline: ")) << session_.status();
  session_.setClock([t = 0.0]() mutable { return t += 0.001; });
  session_.renderFrame();
  EXPECT_TRUE(session_.runAction(action("a.json"))) << session_.status();
  EXPECT_TRUE(session_.runAction(action("a.csv"))) << session_.status();
  EXPECT_FALSE(session_.runAction(action("a.txt")));
  EXPECT_FALSE(session_.runAction(action("no/such/folder/a.csv")));
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"a.csv", "a.json"}));  // and no partial files
}

}  // namespace
}  // namespace lamplighter
