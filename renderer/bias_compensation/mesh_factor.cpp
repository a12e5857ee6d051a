#include "renderer/bias_compensation/mesh_factor.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "renderer/raycast/ray_caster.h"
#include "renderer/surface_light/form_factor.h"

namespace lamplighter {
namespace {

// The point of an edge on the horizon, by the heights of its ends.
glm::dvec3 onHorizon(const glm::dvec3& a, const glm::dvec3& b, double ha, double hb) {
  return a + (b - a) * (ha / (ha - hb));
}

}  // namespace

MeshFactor::MeshFactor(std::span<const vec3> corners, bool bothSides) : bothSides_(bothSides) {
  std::map<std::tuple<float, float, float>, uint32_t> vertexAt;
  for (const vec3& c : corners) {
    const auto next = static_cast<uint32_t>(vertices_.size());
    bounds_.add(c);
    const auto [it, isNew] = vertexAt.try_emplace({c.x, c.y, c.z}, next);
    if (isNew) vertices_.push_back(c);
    corners_.push_back(it->second);
  }
  std::map<std::pair<uint32_t, uint32_t>, std::vector<size_t>> open;  // edges without a neighbour
  for (size_t t = 0; t < corners.size() / 3; ++t) {
    const vec3& a = corners[3 * t];
    const vec3 normal = glm::cross(corners[3 * t + 1] - a, corners[3 * t + 2] - a);
    cornerX_.push_back(a.x);
    cornerY_.push_back(a.y);
    cornerZ_.push_back(a.z);
    normalX_.push_back(normal.x);
    normalY_.push_back(normal.y);
    normalZ_.push_back(normal.z);
    area_.push_back(glm::length(normal));
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t from = corners_[3 * t + k], to = corners_[3 * t + (k + 1) % 3];
      std::vector<size_t>& neighbours = open[{to, from}];
      if (neighbours.empty()) {
        open[{from, to}].push_back(edges_.size());
        edges_.push_back({from, to, static_cast<uint16_t>(t), kNoTriangle});
      } else {
        edges_[neighbours.back()].backwards = static_cast<uint16_t>(t);
        neighbours.pop_back();
      }
    }
  }
}

float MeshFactor::at(const vec3& x, const vec3& n) const {
  // 1: the triangle faces x; -1: x sees its back, which emits; 0: it does not count.
  std::array<int8_t, kMostTriangles + 1> facing;
  const size_t triangles = area_.size();
  const float slack = rayEpsilon(x);
  for (size_t t = 0; t < triangles; ++t) {
    const float height = normalX_[t] * (x.x - cornerX_[t]) + normalY_[t] * (x.y - cornerY_[t]) +
                         normalZ_[t] * (x.z - cornerZ_[t]);
    const float least = slack * area_[t];
    facing[t] = static_cast<int8_t>((height > least) - (bothSides_ && height < -least));
  }
  facing[kNoTriangle] = 0;
  const glm::dvec3 origin(x), normal(n);
  const auto place = [&](uint32_t vertex) { return glm::dvec3(vertices_[vertex]) - origin; };
  // Outlines, as far as they are above the horizon.
  double sum = 0.0;
  for (const Edge& e : edges_) {
    const int weight = facing[e.forwards] - facing[e.backwards];
    if (weight == 0) continue;
    glm::dvec3 a = place(e.from), b = place(e.to);
    const double ha = glm::dot(a, normal), hb = glm::dot(b, normal);
    if (ha < 0.0 && hb < 0.0) continue;
    if (ha < 0.0) a = onHorizon(b, a, hb, ha);
    if (hb < 0.0) b = onHorizon(a, b, ha, hb);
    sum += weight * edgeFactor(a, b, normal);
  }
  // What closes the outline of each triangle along the horizon.
  const vec3 middle = 0.5f * (bounds_.min + bounds_.max), half = bounds_.max - middle;
  const bool isAbove = glm::dot(middle - x, n) >= glm::dot(half, glm::abs(n)) + slack;
  for (size_t t = 0; !isAbove && t < triangles; ++t) {
    if (facing[t] == 0) continue;
    std::array<glm::dvec3, 3> p;
    std::array<double, 3> h;
    for (size_t k = 0; k < 3; ++k) {
      p[k] = place(corners_[3 * t + k]);
      h[k] = glm::dot(p[k], normal);
    }
    if (std::ranges::min(h) >= 0.0 || std::ranges::max(h) < 0.0) continue;
    glm::dvec3 down(0.0), up(0.0);
    for (size_t k = 0; k < 3; ++k) {
      const size_t next = (k + 1) % 3;
      if (h[k] >= 0.0 && h[next] < 0.0) down = onHorizon(p[k], p[next], h[k], h[next]);
      if (h[k] < 0.0 && h[next] >= 0.0) up = onHorizon(p[next], p[k], h[next], h[k]);
    }
    sum += facing[t] * edgeFactor(down, up, normal);
  }
  // Triangles that face x run clockwise about n.
  return static_cast<float>(std::max(-0.5 * sum, 0.0));
}

}  // namespace lamplighter
