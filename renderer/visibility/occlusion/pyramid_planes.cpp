#include "renderer/visibility/occlusion/pyramid_planes.h"

#include <algorithm>
#include <bit>

#include "renderer/visibility/occlusion/plane_lanes.h"

namespace lamplighter {
namespace {

// Clipping by one plane adds at most one corner.
constexpr size_t kMostCorners = 3 + PyramidPlanes::kMost;

static_assert(PyramidPlanes::kMost == hn::MaxLanes(kTag));
PlaneLanes<Floats8> load(const PyramidPlanes& p) {
  return {{hn::LoadU(kTag, p.x.data()), hn::LoadU(kTag, p.y.data()), hn::LoadU(kTag, p.z.data())},
          hn::LoadU(kTag, p.offset.data())};
}

}  // namespace

bool PyramidPlanes::mayMeet(const Bounds& box) const {
  const Floats8 depth =
      depthOf(load(*this), broadcast(box.centre()), broadcast(0.5f * box.extent()));
  return hn::AllFalse(kTag, hn::Lt(depth, hn::Zero(kTag)));
}

bool PyramidPlanes::reach(const vec3& point, float depth) const {
  return hn::AllFalse(kTag, hn::Lt(distanceOf(load(*this), broadcast(point)), broadcast(depth)));
}

bool PyramidPlanes::meet(const vec3& a, const vec3& b, const vec3& c, vec3* at) const {
  // Most triangles are completely outside one plane, or have a corner inside all planes.
  const PlaneLanes<Floats8> planes = load(*this);
  const auto outsideOf = [&](const vec3& p) {
    return hn::Lt(distanceOf(planes, broadcast(p)), hn::Zero(kTag));
  };
  const std::array<vec3, 3> points{a, b, c};
  const std::array outside{outsideOf(a), outsideOf(b), outsideOf(c)};
  if (!hn::AllFalse(kTag, hn::And(outside[0], hn::And(outside[1], outside[2])))) return false;
  for (size_t i = 0; i < 3; ++i) {
    if (!hn::AllFalse(kTag, outside[i])) continue;
    if (at != nullptr) *at = points[i];
    return true;
  }
  if (at != nullptr) *at = a;  // replaced if a better one is found

  // Planes that have all corners inside clip nothing.
  uint8_t cutting[8];
  hn::StoreMaskBits(kTag, hn::Or(outside[0], hn::Or(outside[1], outside[2])), cutting);
  std::array<std::array<vec3, kMostCorners>, 2> polygons;
  std::copy(points.begin(), points.end(), polygons[0].begin());
  size_t count = 3, now = 0;
  for (uint32_t rest = cutting[0]; rest != 0; rest &= rest - 1) {
    const auto n = static_cast<size_t>(std::countr_zero(rest));
    const vec3 normal(x[n], y[n], z[n]);
    const auto distance = [&](const vec3& p) { return glm::dot(normal, p) + offset[n]; };
    const auto& corners = polygons[now];
    auto& clipped = polygons[1 - now];
    size_t kept = 0;
    float df = distance(corners[0]);
    for (size_t k = 0; k < count; ++k) {
      const vec3 &from = corners[k], &to = corners[k + 1 < count ? k + 1 : 0];
      const float dt = distance(to);
      if (df >= 0.0f) clipped[kept++] = from;
      if ((df >= 0.0f) != (dt >= 0.0f)) clipped[kept++] = from + (df / (df - dt)) * (to - from);
      if (kept + 2 > kMostCorners) return true;
      df = dt;
    }
    if (kept == 0) return false;
    now = 1 - now;
    count = kept;
  }
  if (at != nullptr) {
    *at = vec3(0.0f);
    for (size_t k = 0; k < count; ++k) *at += polygons[now][k];
    *at /= static_cast<float>(count);
  }
  return true;
}

}  // namespace lamplighter
