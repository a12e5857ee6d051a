#include "renderer/visibility/movers/mover_path.h"

#include <algorithm>
#include <limits>

namespace lamplighter {
namespace {

// Counts per mover radius. Small counts are precise, since marks are rounded down; but the path of
// a few steps must fit into the range.
constexpr float kCountsASize = 100.0f;

// Factor for rounding errors and for spheres that are slightly larger than the movers.
constexpr float kWider = 1.01f;

// The metric gets an axis if two steps are straight within this cosine (one degree). Drags along an
// axis of the level are; free drags hardly ever are. The metric becomes isotropic again if a step
// is longer than kMostTimes its isotropic length, because it leaves the axis or the mover rotates.
constexpr float kStraight = 0.99985f;
constexpr float kAcross = 8.0f;
constexpr float kMostTimes = 2.0f;

float farthestStep(std::span<const MoverPlace> before, std::span<const MoverPlace> now,
                   const MotionMetric& metric) {
  float step = 0.0f;
  for (size_t m = 0; m < now.size(); ++m)
    step = std::max(step, farthestStep(before[m], now[m], metric));
  return step;
}

}  // namespace

float farthestStep(const MoverPlace& before, const MoverPlace& now, const MotionMetric& metric) {
  if (before.groups.size() != now.groups.size() || before.caster.box.empty())
    return std::numeric_limits<float>::infinity();
  float farthest = metric.lengthOf(now.caster.box.centre() - before.caster.box.centre()) +
                   metric.most() * std::abs(now.caster.radius - before.caster.radius);
  for (size_t i = 0; i < now.groups.size(); ++i) {
    const Bounds &a = before.groups[i], &b = now.groups[i];
    farthest = std::max(farthest, metric.lengthOf(b.centre() - a.centre()) +
                                      0.5f * metric.most() * glm::distance(a.extent(), b.extent()));
  }
  return farthest;
}

MoverPath::Mark MoverPath::makeVoid() {
  at_ = kFirst;
  return static_cast<Mark>(kLast);
}

// Whether the metric changes with this step.
bool MoverPath::turn(std::span<const MoverPlace> before, std::span<const MoverPlace> now) {
  const vec3 shift = now[0].caster.box.centre() - before[0].caster.box.centre();
  MotionMetric metric = metric_;
  if (const float length = glm::length(shift); length > 0.0f) {
    const vec3 direction = shift / length;
    const auto isAlong = [&](const vec3& other) {
      return std::abs(glm::dot(direction, other)) > kStraight;
    };
    if (isAlong(direction_) && !isAlong(metric.axis)) metric = {direction, kAcross};
    direction_ = direction;
  }
  if (farthestStep(before, now, metric) > kMostTimes * farthestStep(before, now, MotionMetric()))
    metric = MotionMetric();
  if (metric == metric_) return false;
  metric_ = metric;
  return true;
}

MoverPath::Mark MoverPath::advance(std::span<const MoverPlace> before,
                                   std::span<const MoverPlace> now) {
  if (now.empty()) return makeVoid();
  const bool turns = turn(before, now);
  float size = std::numeric_limits<float>::max();
  for (const MoverPlace& place : now) size = std::min(size, place.caster.radius);
  const Mark by = advance(farthestStep(before, now, metric_), size);
  return turns ? makeVoid() : by;
}

MoverPath::Mark MoverPath::advance(float distance, float size) {
  if (count_ == 0.0f) count_ = size / kCountsASize;
  ++steps_;
  lastStep_ = distance;
  const float counts = kWider * distance / count_;
  if (!(at_ + counts < kLast)) return makeVoid();  // also if the distance is NaN or infinite
  at_ += counts;
  if (at_ < kFirst + kLowerBy) return 0;
  at_ -= kLowerBy;
  return kLowerBy;
}

}  // namespace lamplighter
