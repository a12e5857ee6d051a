#include "renderer/sampling/view_points.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/low_discrepancy.h"
#include "renderer/scene/light_linking.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// How far beyond the picture's edges points may be, as a fraction of its size.
constexpr float kMargin = 0.1f;
constexpr float kEyeGrid = 0.5f;  // metres
constexpr float kTurnGrid = 15.0f * kPi / 180.0f;
constexpr int kSteadyHeight = 1024;  // makes the result depend only on the aspect ratio of the
                                     // picture
constexpr uint32_t kPointSet = 0x5d;

}  // namespace

std::vector<SeenPoint> seenPoints(const RenderScene& scene, const RayCaster& rays, const View& view,
                                  int count, int first) {
  std::vector<SeenPoint> points;
  points.reserve(static_cast<size_t>(count));
  const vec2 size(view.width, view.height);
  for (int i = first; i < first + count; ++i) {
    const vec2 u = sobol2(static_cast<uint32_t>(i), kPointSet);
    const vec2 at = ((1.0f + 2.0f * kMargin) * u - kMargin) * size;
    const vec3 direction = view.rayDirection(at.x, at.y);
    const float tNear = view.znear / glm::dot(direction, view.forward());
    const Hit hit = rays.intersect({view.eye, tNear, direction}, Surfaces::seen);
    if (!hit) continue;
    const Surface s = surfaceAt(scene, hit.object, hit.triangle, hit.u, hit.v);
    const float side = glm::dot(direction, s.geometricNormal) < 0.0f ? 1.0f : -1.0f;
    const vec3 normal = side * s.geometricNormal;
    points.push_back({s.position + rayEpsilon(s.position) * normal, normal,
                      scene.objects[hit.object].leftOutBy});
  }
  return points;
}

View steadyView(const View& view, const RayCaster& rays) {
  const auto onGrid = [](float value, float step) { return std::round(value / step) * step; };
  View steady = view;
  steady.height = kSteadyHeight;
  steady.width = static_cast<int>(std::lround(view.aspect() * static_cast<float>(kSteadyHeight)));
  const vec3 forward = view.forward();
  const float pitch = onGrid(std::asin(std::clamp(forward.y, -1.0f, 1.0f)), kTurnGrid);
  const float yaw = onGrid(std::atan2(-forward.x, -forward.z), kTurnGrid);
  steady.orientation = glm::angleAxis(yaw, vec3(0, 1, 0)) * glm::angleAxis(pitch, vec3(1, 0, 0));
  const vec3 eye(onGrid(view.eye.x, kEyeGrid), onGrid(view.eye.y, kEyeGrid),
                 onGrid(view.eye.z, kEyeGrid));
  const float way = glm::length(eye - view.eye);
  // Tests slightly further than the grid point, so that the eye is not inside a wall that it
  // touches.
  if (way > 0.0f && !rays.occluded({view.eye, 0.0f, (eye - view.eye) / way, way + 0.1f}))
    steady.eye = eye;
  return steady;
}

}  // namespace lamplighter
