#include "renderer/methods/frame_time_control.h"

#include <algorithm>

namespace lamplighter {
namespace {

constexpr double kWeight = 0.5;  // of the last frame in the running mean
constexpr double kMostGrowth = 2.0, kLeastGrowth = 0.5;

// At least this number of updates is made at any cost: a slow picture that converges is better
// than one that never does.
constexpr int kLeastUpdates = 16;

void average(double& mean, double value) {
  mean = mean == 0.0 ? value : mean + kWeight * (value - mean);
}

}  // namespace

void FrameTimeControl::measured(const GiStats& stats) {
  double seconds = 0.0;
  for (const auto& [stage, time] : stats.stageSeconds) seconds += time;
  // Ignores frames that say nothing about the limit: without updates, or with fewer than
  // allowed in less time than wanted.
  if (stats.updates == 0 || (stats.updates < allowed_ && seconds < wanted_)) return;
  average(updates_, stats.updates);
  average(seconds_, seconds);
}

// A part of the frame time is independent of the number of updates, so this approaches the right
// number in steps and never exceeds it.
int FrameTimeControl::updatesWithin(double seconds) {
  wanted_ = seconds;
  allowed_ = kLeastUpdates;
  if (seconds_ > 0.0) {
    const double growth = std::clamp(seconds / seconds_, kLeastGrowth, kMostGrowth);
    allowed_ = std::max(kLeastUpdates, static_cast<int>(std::min(growth * updates_, 65536.0)));
  }
  return allowed_;
}

}  // namespace lamplighter
