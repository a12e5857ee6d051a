#include "renderer/prt/incident_light_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lamplighter {
namespace {

constexpr float kPointsPerSquareMetre = 64.0f;
constexpr float kTowardsMiddle = 0.1f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Weights (1 − d/R)², where R is the distance of the nearest point that is not blended. So a point
// enters and leaves the blend with weight 0, and the light is continuous over the surface.
IncidentLightPoints::Blend blendAt(const vec3& position, const std::vector<vec3>& points) {
  constexpr size_t kNearest = IncidentLightPoints::kBlended + 1;
  std::array<float, kNearest> distance;
  distance.fill(kInfinity);
  std::array<uint8_t, kNearest> index{};
  for (size_t i = 0; i < points.size(); ++i) {
    float d = glm::distance(position, points[i]);
    auto at = static_cast<uint8_t>(i);
    for (size_t k = 0; k < kNearest; ++k) {
      if (!(d < distance[k])) continue;
      std::swap(d, distance[k]);
      std::swap(at, index[k]);
    }
  }
  IncidentLightPoints::Blend out;
  const size_t count = std::min(points.size(), IncidentLightPoints::kBlended);
  // If all points are blended, none ever leaves.
  const float reach = points.size() > count ? distance[count] : 2.0f * distance[count - 1];
  float sum = 0.0f;
  for (size_t k = 0; k < count; ++k) {
    const float share = reach > 0.0f ? 1.0f - distance[k] / reach : 1.0f;
    out.point[k] = index[k];
    out.weight[k] = share * share;
    sum += out.weight[k];
  }
  if (!(sum > 0.0f)) {  // all at the same distance
    for (size_t k = 0; k < count; ++k) out.weight[k] = 1.0f;
    sum = static_cast<float>(count);
  }
  for (float& w : out.weight) w /= sum;
  return out;
}

}  // namespace

int lightPointsFor(float size, int most) {
  const float wanted = kPointsPerSquareMetre * size * size;
  const int limit = std::clamp(most, 1, kMostLightPoints);
  return std::clamp(static_cast<int>(std::round(std::min(wanted, 1e4f))), 1, limit);
}

IncidentLightPoints placeIncidentLightPoints(const RenderScene& own, int count) {
  const vec3 middle = own.bounds.centre();
  const size_t vertices = own.positions.size();
  IncidentLightPoints out;
  // For each vertex the distance to the nearest chosen point; initially to the centre, so that the
  // first point is an outer one.
  std::vector<float> distance(vertices);
  for (size_t v = 0; v < vertices; ++v) distance[v] = glm::distance(own.positions[v], middle);
  if (count <= 1 || vertices == 0) {
    out.places.push_back(middle);
  } else {
    for (int i = 0; i < count; ++i) {
      const auto farthest = std::max_element(distance.begin(), distance.end());
      if (i > 0 && !(*farthest > 0.0f)) break;  // fewer distinct positions than points
      const vec3 at = own.positions[static_cast<size_t>(farthest - distance.begin())];
      out.places.push_back(glm::mix(at, middle, kTowardsMiddle));
      for (size_t v = 0; v < vertices; ++v) {
        const float d = glm::distance(own.positions[v], at);
        distance[v] = i == 0 ? d : std::min(distance[v], d);
      }
    }
  }
  for (const float d : distance) out.spacing = std::max(out.spacing, d);
  out.ofVertex.reserve(vertices);
  for (const vec3& p : own.positions) out.ofVertex.push_back(blendAt(p, out.places));
  return out;
}

}  // namespace lamplighter
