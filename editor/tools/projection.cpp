#include "editor/tools/projection.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {

std::optional<Segment2> projectSegment(const View& view, vec3 a, vec3 b) {
  const float near = view.znear;
  const float da = glm::dot(a - view.eye, view.forward()),
              db = glm::dot(b - view.eye, view.forward());
  if (da < near && db < near) return std::nullopt;
  if (da < near) a += (b - a) * ((near - da) / (db - da));
  if (db < near) b += (a - b) * ((near - db) / (da - db));
  return Segment2{vec2(view.project(a)), vec2(view.project(b))};
}

std::optional<vec2> projectPoint(const View& view, const vec3& p) {
  const vec3 q = view.project(p);
  if (q.z < view.znear) return std::nullopt;
  return vec2(q);
}

float metresPerPixel(const View& view, const vec3& p) {
  const float depth = std::max(glm::dot(p - view.eye, view.forward()), view.znear);
  return 2.0f * std::tan(0.5f * view.yfov) * depth / static_cast<float>(view.height);
}

std::optional<vec3> onPlane(const View& view, const vec2& pixel, const vec3& origin,
                            const vec3& normal) {
  const vec3 direction = view.rayDirection(pixel.x, pixel.y);
  const float along = glm::dot(normal, direction);
  if (std::abs(along) < 1e-4f) return std::nullopt;
  const float t = glm::dot(normal, origin - view.eye) / along;
  constexpr float kFarthest = 100.0f;  // multiple of the distance from the eye to the origin
  if (t <= 0.0f || t > kFarthest * glm::length(origin - view.eye)) return std::nullopt;
  return view.eye + t * direction;
}

float distanceToSegment(const vec2& p, const vec2& a, const vec2& b) {
  const vec2 d = b - a;
  const float length2 = glm::dot(d, d);
  const float t = length2 > 0.0f ? std::clamp(glm::dot(p - a, d) / length2, 0.0f, 1.0f) : 0.0f;
  return glm::length(p - (a + t * d));
}

void addLine(Overlay& overlay, const View& view, const vec3& a, const vec3& b, const vec4& colour,
             float thickness) {
  if (const auto s = projectSegment(view, a, b))
    overlay.shapes.push_back({{s->a, s->b}, false, false, colour, thickness});
}

void addLoop(Overlay& overlay, const View& view, const std::vector<vec3>& points,
             const vec4& colour, float thickness) {
  for (size_t i = 0; i < points.size(); ++i) {
    addLine(overlay, view, points[i], points[(i + 1) % points.size()], colour, thickness);
  }
}

std::vector<vec3> circle(const vec3& centre, const vec3& u, const vec3& v, float radius,
                         int sides) {
  std::vector<vec3> points;
  for (int i = 0; i < sides; ++i) {
    const float a = 2.0f * kPi * static_cast<float>(i) / static_cast<float>(sides);
    points.push_back(centre + radius * (std::cos(a) * u + std::sin(a) * v));
  }
  return points;
}

}  // namespace lamplighter
