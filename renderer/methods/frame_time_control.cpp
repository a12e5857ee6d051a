#include "renderer/methods/frame_time_control.h"

#include <algorithm>

namespace lamplighter {
namespace {

constexpr double kWeight = 0.5;  // of the last frame against those before
constexpr double kMostGrowth = 2.0, kLeastGrowth = 0.5;

// A slow picture that never becomes right is worse than one that is slower still: so many VPLs are
// refreshed whatever they cost.
constexpr int kLeastVpls = 16;

void average(double& mean, double value) {
  mean = mean == 0.0 ? value : mean + kWeight * (value - mean);
}

}  // namespace

void FrameTimeControl::measured(const GiStats& stats) {
  double seconds = 0.0;
  for (const auto& [stage, time] : stats.stageSeconds) seconds += time;
  // A frame in which nothing changed says nothing of one in which something does, and one with
  // less to do than it might have done does not say how much more would have been too much.
  if (stats.vplsRefreshed == 0 || (stats.vplsRefreshed < allowed_ && seconds < wanted_)) return;
  average(vpls_, stats.vplsRefreshed);
  average(seconds_, seconds);
}

// Some of a frame's time does not depend on how many there are, so that this comes nearer to the
// right number step by step, and never past it.
int FrameTimeControl::vplsWithin(double seconds) {
  wanted_ = seconds;
  allowed_ = kLeastVpls;
  if (seconds_ > 0.0) {
    const double growth = std::clamp(seconds / seconds_, kLeastGrowth, kMostGrowth);
    allowed_ = std::max(kLeastVpls, static_cast<int>(std::min(growth * vpls_, 65536.0)));
  }
  return allowed_;
}

}  // namespace lamplighter
