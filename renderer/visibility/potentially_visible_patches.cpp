#include "renderer/visibility/potentially_visible_patches.h"

#include <cmath>

namespace lamplighter {
namespace {

// Largest pixel offset of antialiasing.
constexpr float kShift = 1.0f;
// Sine of an upper bound of the angle between a triangle and a chart that is not rough.
constexpr float kTurned = 0.05f;

Frustum frustumOf(View view) {
  const float pixels = static_cast<float>(view.height);
  view.yfov = 2.0f * std::atan(std::tan(0.5f * view.yfov) * (1.0f + 2.0f * kShift / pixels));
  return Frustum(view.worldToClip());
}

}  // namespace

PotentiallyVisiblePatches::PotentiallyVisiblePatches(const View& view)
    : eye_(view.eye), frustum_(frustumOf(view)) {}

bool PotentiallyVisiblePatches::mayShow(const Patch& patch) const {
  // Slightly enlarged because of rounding errors.
  const vec3 half(1.01f * patch.radius + 0.001f);
  return frustum_.mayMeet({patch.centre - half, patch.centre + half});
}

bool PotentiallyVisiblePatches::mayShowFront(const Chart& chart, const Patch& patch) const {
  const vec3 way = eye_ - patch.centre;
  const float slack = chart.thickness + 0.001f + kTurned * (glm::length(way) + patch.radius);
  if (!chart.isRough && glm::dot(way, chart.normal) < -slack) return false;
  return mayShow(patch);
}

}  // namespace lamplighter
