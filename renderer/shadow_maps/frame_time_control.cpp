#include "renderer/shadow_maps/frame_time_control.h"

#include <algorithm>
#include <string_view>

namespace lamplighter {
namespace {

constexpr double kWeight = 0.3;  // of the last frame against those before

// A slow picture that never becomes right is worse than one that is slower still: so much of the
// time goes into refreshing even where the rest alone takes longer than all, and so many VPLs are
// refreshed whatever they cost.
constexpr double kLeastShare = 0.3;
constexpr int kLeastVpls = 16;

void average(double& mean, double value) {
  mean = mean == 0.0 ? value : mean + kWeight * (value - mean);
}

}  // namespace

void FrameTimeControl::measured(const GiStats& stats) {
  double all = 0.0, refreshing = 0.0;
  for (const auto& [stage, seconds] : stats.stageSeconds) {
    all += seconds;
    if (stage == "shadow maps" || stage == "visibility" || stage == "light maps")
      refreshing += seconds;
  }
  // A frame in which nothing changed says nothing of one in which something does.
  if (stats.mapsRendered == 0) return;
  average(perVpl_, refreshing / stats.mapsRendered);
  average(rest_, all - refreshing);
}

int FrameTimeControl::vplsWithin(double seconds) const {
  if (perVpl_ <= 0.0) return kLeastVpls;
  const double share = std::max(seconds - rest_, kLeastShare * seconds);
  return std::max(kLeastVpls, static_cast<int>(std::min(share / perVpl_, 65536.0)));
}

}  // namespace lamplighter
