#include "renderer/patches/charts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lamplighter {
namespace {

Chart placed(const RenderScene& s, uint32_t object, const ChartTopology& topology) {
  const RenderObject& o = s.objects[object];
  const auto corner = [&](uint32_t t, uint32_t c) -> const vec3& {
    return s.positions[s.indices[o.firstIndex + 3 * t + c]];
  };
  const auto cross = [&](uint32_t t) {
    return glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
  };
  Chart chart;
  chart.object = object;
  chart.triangles = topology.triangles;
  chart.origin = corner(topology.triangles.front(), 0);
  chart.isRough = topology.isRough;
  vec3 plane = cross(topology.seed);
  if (chart.isRough) {
    plane = vec3(0.0f);
    for (const uint32_t t : chart.triangles) plane += cross(t);
  }
  const float length = glm::length(plane);
  chart.normal = length > 0.0f ? plane / length : vec3(0, 1, 0);
  if (chart.isRough) {
    float lowest = 0.0f, highest = 0.0f;
    for (const uint32_t t : chart.triangles) {
      for (uint32_t c = 0; c < 3; ++c) {
        const float height = glm::dot(corner(t, c) - chart.origin, chart.normal);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
      }
    }
    chart.origin += 0.5f * (lowest + highest) * chart.normal;
  }
  for (const uint32_t v : topology.outline) chart.outline.push_back(s.positions[o.firstVertex + v]);
  vec3 along = s.positions[o.firstVertex + topology.longestEdge[1]] -
               s.positions[o.firstVertex + topology.longestEdge[0]];
  along -= glm::dot(along, chart.normal) * chart.normal;
  const float alongLength = glm::length(along);
  chart.tangent = alongLength > 0.0f ? along / alongLength : Frame(chart.normal).tangent;
  chart.bitangent = glm::cross(chart.normal, chart.tangent);
  chart.min = vec2(std::numeric_limits<float>::infinity());
  chart.max = -chart.min;
  for (const uint32_t t : chart.triangles) {
    chart.area += 0.5f * glm::length(cross(t));
    for (uint32_t c = 0; c < 3; ++c) {
      const vec3& p = corner(t, c);
      chart.thickness =
          std::max(chart.thickness, std::abs(glm::dot(p - chart.origin, chart.normal)));
      chart.min = glm::min(chart.min, chart.project(p));
      chart.max = glm::max(chart.max, chart.project(p));
    }
  }
  return chart;
}

}  // namespace

std::vector<Chart> placeCharts(const RenderScene& scene, uint32_t object,
                               const MeshTopology& topology) {
  std::vector<Chart> charts;
  charts.reserve(topology.charts.size());
  for (const ChartTopology& t : topology.charts) charts.push_back(placed(scene, object, t));
  return charts;
}

}  // namespace lamplighter
