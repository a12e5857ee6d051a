#include "renderer/methods/frame_time_control.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {
namespace {

constexpr double kWeight = 0.5;  // of the last frame in the running mean
constexpr double kLeastGrowth = 0.5;

// Minimum work per frame: a slow picture that converges is better than one that never does.
constexpr double kLeastUpdates = 16.0, kMostUpdates = 65536.0;
constexpr double kLeastSurfaceWork = 0.15, kMostSurfaceWork = 8.0;

// Work of the first frame, whose time is not known. It takes long anyway, because a level was
// opened.
constexpr double kFirstUpdates = 64.0;

// Minimum share of the limit for each kind of work. Without it, light on surfaces would leave
// nothing to the direct light of a dragged lamp, which would lag behind.
constexpr double kLeastShare = 0.25;
// The share of the time for paths that repair a picture before it has settled. A larger one would
// delay the picture itself.
constexpr double kPreviewShare = 0.7;

void average(double& mean, double value) {
  mean = mean == 0.0 ? value : mean + kWeight * (value - mean);
}

}  // namespace

// Ignores frames without information about the limit: without such work, or with less work than
// allowed in less time than wanted.
void WorkRate::measured(double amount, double seconds, double all) {
  if (amount == 0.0 || (amount < allowed_ && all < wanted_)) return;
  average(amount_, amount);
  average(seconds_, seconds);
}

// A part of the time may not depend on the amount, so this approaches the right one in steps.
double WorkRate::within(double seconds, double all, double least, double most, double first) {
  wanted_ = all;
  allowed_ = first;
  if (seconds_ > 0.0) {
    const double growth = std::clamp(seconds / seconds_, kLeastGrowth, mostGrowth_);
    allowed_ = std::clamp(growth * amount_, least, most);
    if (isWhole_) allowed_ = std::floor(allowed_);
  }
  return allowed_;
}

void FrameTimeControl::measured(const GiStats& stats) {
  double all = 0.0, ofUpdates = 0.0, ofSurfaces = 0.0, ofPreview = 0.0;
  for (const auto& [stage, time] : stats.stageSeconds) {
    all += time;
    if (stage.work == StageWork::updates) ofUpdates += time;
    if (stage.work == StageWork::surfaces) ofSurfaces += time;
    if (stage.work == StageWork::preview) ofPreview += time;
  }
  // If no stage declares its kind, all work counts as updates.
  if (ofUpdates == 0.0) ofUpdates = all - ofSurfaces;
  updates_.measured(stats.updates, ofUpdates, all);
  surfaces_.measured(static_cast<double>(stats.surfaceWork), ofSurfaces, all);
  refinement_.measured(stats.refineUpdates, all, all);
  if (stats.updates == 0 && stats.surfaceWork == 0.0f) {
    preview_.measured(stats.previewUpdates, ofPreview, all);
    return;
  }
  average(ofUpdates_, ofUpdates);
  average(ofSurfaces_, ofSurfaces);
  average(rest_, all - ofUpdates - ofSurfaces);
}

FrameTimeControl::Work FrameTimeControl::within(double seconds) {
  const double share = kLeastShare * seconds;
  const double forUpdates = seconds - rest_ - std::min(ofSurfaces_, share);
  const double forSurfaces = seconds - rest_ - ofUpdates_;
  Work work;
  work.updates = static_cast<int>(updates_.within(std::max(forUpdates, share), seconds,
                                                  kLeastUpdates, kMostUpdates, kFirstUpdates));
  work.surfaces =
      static_cast<float>(surfaces_.within(std::max(forSurfaces, share), seconds, kLeastSurfaceWork,
                                          kMostSurfaceWork, kLeastSurfaceWork));
  work.refineUpdates = static_cast<int>(
      refinement_.within(seconds, seconds, kLeastUpdates, kMostUpdates, kLeastUpdates));
  work.previewUpdates = static_cast<int>(
      preview_.within(seconds, seconds, kLeastUpdates, kMostUpdates, kFirstUpdates));
  const double ofMethod = ofUpdates_ + ofSurfaces_ + rest_;
  const double frames = kPreviewShare / (1.0 - kPreviewShare) * ofMethod / seconds;
  work.previewFrames = std::max(static_cast<int>(std::lround(frames)), 1);
  return work;
}

}  // namespace lamplighter
