#include "editor/timeline/timeline.h"

#include <algorithm>

namespace lamplighter {
namespace {

constexpr double kSecondsKept = 10.0;
constexpr size_t kFramesKept = 2000;

}  // namespace

const std::vector<std::string>& Timeline::stages() {
  static const std::vector<std::string> names{
      "light samples", "visibility", "shadow maps", "finer maps",  "light maps",
      "transfer",      "g-buffer",   "light sums",  "composition", "antialiasing",
      "corners",       "refinement", "paths",       "other"};
  return names;
}

void Timeline::add(uint32_t frame, double begin, double end, const GiStats& stats) {
  if (!(end > begin)) return;
  FrameTiming timing{frame, begin, end, std::vector<double>(stages().size()), stats};
  double rest = timing.seconds();
  for (const auto& [name, seconds] : stats.stageSeconds) {
    const auto found = std::find(stages().begin(), stages().end(), name);
    if (found == stages().end()) continue;  // it counts as "other"
    timing.stageSeconds[static_cast<size_t>(found - stages().begin())] = seconds;
    rest -= seconds;
  }
  timing.stageSeconds.back() = std::max(rest, 0.0);
  frames_.push_back(std::move(timing));
  while (frames_.size() > kFramesKept || end - frames_.front().end > kSecondsKept)
    frames_.pop_front();
}

double Timeline::meanOf(size_t stage) const {
  double sum = 0.0;
  int count = 0;
  for (const FrameTiming& f : frames_) {
    if (f.stageSeconds[stage] <= 0.0) continue;
    sum += f.stageSeconds[stage];
    ++count;
  }
  return count == 0 ? 0.0 : sum / count;
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
