#include "renderer/surface_light/form_factor.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lamplighter {

namespace {

// The angle in [0, π] of the direction (cosine, sine), of any length, with sine > 0. Unlike
// std::atan2 it has the same bits on all processors.
double angleOf(double cosine, double sine) {
  const double length = std::sqrt(cosine * cosine + sine * sine);
  double t = cosine >= 0.0 ? sine / (length + cosine) : (length - cosine) / sine;  // of the half
  for (int half = 0; half < 3; ++half) t /= 1.0 + std::sqrt(1.0 + t * t);
  // The series of the arc tangent up to t¹⁷; t is at most tan(π/16).
  double sum = 0.0;
  for (int power = 17; power > 0; power -= 2) sum = 1.0 / power - t * t * sum;
  return 16.0 * t * sum;
}

}  // namespace

double edgeFactor(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& n) {
  const glm::dvec3 cross = glm::cross(a, b);
  const double sine = glm::length(cross);
  return sine > 0.0 ? angleOf(glm::dot(a, b), sine) / sine * glm::dot(cross, n) : 0.0;
}

float polygonFactor(const vec3& x, const vec3& n, std::span<const vec3> polygon) {
  // Relative to x, clipped at the plane through x: a convex polygon gains at most one corner.
  std::array<glm::dvec3, kMostCorners + 1> corners;
  size_t count = 0;
  const glm::dvec3 normal(n);
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = glm::dvec3(polygon[i]) - glm::dvec3(x);
    const glm::dvec3 b = glm::dvec3(polygon[(i + 1) % polygon.size()]) - glm::dvec3(x);
    const double ha = glm::dot(a, normal), hb = glm::dot(b, normal);
    if (ha >= 0.0) corners[count++] = a;
    if ((ha > 0.0 && hb < 0.0) || (ha < 0.0 && hb > 0.0))
      corners[count++] = a + (b - a) * (ha / (ha - hb));
  }
  if (count < 3) return 0.0f;
  double sum = 0.0;
  for (size_t i = 0; i < count; ++i)
    sum += edgeFactor(corners[i], corners[(i + 1) % count], normal);
  return static_cast<float>(0.5 * std::abs(sum));
}

}  // namespace lamplighter
