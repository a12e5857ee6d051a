#include "editor/timeline/timeline.h"

#include <algorithm>

namespace lamplighter {
namespace {

constexpr double kSecondsKept = 10.0;
constexpr size_t kFramesKept = 2000;

}  // namespace

void Timeline::add(uint32_t frame, double begin, double end, const GiStats& stats) {
  if (!(end > begin)) return;
  FrameTiming& timing = frames_.emplace_back(FrameTiming{frame, begin, end, stats});
  double rest = timing.seconds();
  for (const StageTime& time : stats.stageSeconds) rest -= time.seconds;
  timing.stats.stageSeconds.push_back({kOtherStage, std::max(rest, 0.0)});
  while (frames_.size() > kFramesKept || end - frames_.front().end > kSecondsKept)
    frames_.pop_front();
}

double Timeline::meanOf(const StageSpec& stage) const {
  double sum = 0.0;
  int count = 0;
  for (const FrameTiming& f : frames_) {
    const double seconds = f.stats.secondsOf(stage);
    if (seconds <= 0.0) continue;
    sum += seconds;
    ++count;
  }
  return count == 0 ? 0.0 : sum / count;
}

std::vector<StageSpec> Timeline::stages() const {
  std::vector<StageSpec> all;
  for (const FrameTiming& f : frames_) {
    for (const auto& [stage, seconds] : f.stats.stageSeconds)
      if (stage != kOtherStage && std::ranges::find(all, stage) == all.end()) all.push_back(stage);
  }
  all.push_back(kOtherStage);
  return all;
}

std::vector<const StatisticSpec*> Timeline::counters() const {
  std::vector<const StatisticSpec*> all;
  for (const FrameTiming& f : frames_) {
    for (const Statistic& statistic : f.stats.declared) {
      const auto isSame = [&](const StatisticSpec* s) { return s->name == statistic.spec->name; };
      if (statistic.spec->inTimeline && std::none_of(all.begin(), all.end(), isSame))
        all.push_back(statistic.spec);
    }
  }
  return all;
}

}  // namespace lamplighter
