#include "renderer/visibility/mover_path.h"

#include <algorithm>
#include <limits>

namespace lamplighter {
namespace {

// Small, for a mark is rounded down, but the path of a few steps has to fit.
constexpr float kCountsASize = 100.0f;

// Distances are rounded, and spheres around what moves are a little larger than it.
constexpr float kWider = 1.01f;

}  // namespace

float farthestStep(const MoverPlace& before, const MoverPlace& now) {
  if (before.groups.size() != now.groups.size() || before.caster.box.empty())
    return std::numeric_limits<float>::infinity();
  float farthest = glm::distance(before.caster.box.centre(), now.caster.box.centre()) +
                   std::abs(now.caster.radius - before.caster.radius);
  for (size_t i = 0; i < now.groups.size(); ++i) {
    const Bounds &a = before.groups[i], &b = now.groups[i];
    farthest = std::max(farthest, glm::distance(a.centre(), b.centre()) +
                                      0.5f * glm::distance(a.extent(), b.extent()));
  }
  return farthest;
}

MoverPath::Mark MoverPath::advance(float distance, float size) {
  if (count_ == 0.0f) count_ = size / kCountsASize;
  const float counts = kWider * distance / count_;
  if (!(at_ + counts < kLast)) {  // also where nothing can be said
    at_ = kFirst;
    return static_cast<Mark>(kLast);
  }
  at_ += counts;
  if (at_ < kFirst + kLowerBy) return 0;
  at_ -= kLowerBy;
  return kLowerBy;
}

}  // namespace lamplighter
