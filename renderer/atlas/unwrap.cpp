#include "renderer/atlas/unwrap.h"

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace lamplighter {
namespace {

// Largest number of cells per side of the grid for overlap tests.
constexpr float kMostCellsOfChart = 1024.0f;
// Number of edges that are tried as axes of the chart.
constexpr size_t kMostEdges = 24;
// A cell's centre counts as covered if it is inside the triangle by this fraction, so triangles
// that share an edge do not overlap.
constexpr float kInside = 1e-4f;

struct Triangles {
  std::vector<std::array<vec3, 3>> corners;
  std::vector<vec3> normals;  // unit; zero if the triangle has no area
  std::vector<float> areas;
  std::vector<std::vector<uint32_t>> neighbours;  // triangles across an edge
};

Triangles trianglesOf(std::span<const vec3> positions, std::span<const uint32_t> indices) {
  Triangles t;
  const auto count = static_cast<uint32_t>(indices.size() / 3);
  // Welds vertices at equal positions, independent of other attributes.
  const auto byPlace = [](const vec3& a, const vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::map<vec3, uint32_t, decltype(byPlace)> places(byPlace);
  std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> edges;
  t.neighbours.resize(count);
  for (uint32_t i = 0; i < count; ++i) {
    std::array<vec3, 3> corners;
    std::array<uint32_t, 3> place;
    for (uint32_t k = 0; k < 3; ++k) {
      corners[k] = positions[indices[3 * i + k]];
      place[k] = places.emplace(corners[k], static_cast<uint32_t>(places.size())).first->second;
    }
    const vec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const float twice = glm::length(cross);
    t.corners.push_back(corners);
    t.normals.push_back(twice > 0.0f ? cross / twice : vec3(0.0f));
    t.areas.push_back(0.5f * twice);
    if (!(twice > 0.0f)) continue;
    for (uint32_t k = 0; k < 3; ++k) edges[std::minmax(place[k], place[(k + 1) % 3])].push_back(i);
  }
  // If more than two triangles share an edge, each is connected only to the next: a file may
  // contain thousands.
  for (const auto& [edge, users] : edges) {
    for (size_t i = 1; i < users.size(); ++i) {
      t.neighbours[users[i - 1]].push_back(users[i]);
      t.neighbours[users[i]].push_back(users[i - 1]);
    }
  }
  return t;
}

// The occupied cells of a chart's plane.
class Grid {
 public:
  Grid(const MeshChart& chart, float cellsPerMetre) : chart_(chart), cells_(cellsPerMetre) {}

  // Occupies the cells whose centres the triangle covers. Does nothing and returns false if one is
  // occupied.
  bool take(const std::array<vec3, 3>& corners) {
    std::array<vec2, 3> p;
    for (size_t k = 0; k < 3; ++k) p[k] = cells_ * chart_.project(corners[k]);
    const vec2 low = glm::floor(glm::min(p[0], glm::min(p[1], p[2])));
    const vec2 high = glm::ceil(glm::max(p[0], glm::max(p[1], p[2])));
    const float area = cross(p[1] - p[0], p[2] - p[0]);
    if (area == 0.0f) return true;
    std::vector<uint64_t> covered;
    for (int y = static_cast<int>(low.y); y < static_cast<int>(high.y); ++y) {
      for (int x = static_cast<int>(low.x); x < static_cast<int>(high.x); ++x) {
        const vec2 c(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        const float u = cross(p[1] - p[0], c - p[0]) / area,
                    v = cross(c - p[0], p[2] - p[0]) / area;
        if (u <= kInside || v <= kInside || u + v >= 1.0f - kInside) continue;
        const uint64_t cell =
            static_cast<uint64_t>(static_cast<uint32_t>(y)) << 32 | static_cast<uint32_t>(x);
        if (taken_.contains(cell)) return false;
        covered.push_back(cell);
      }
    }
    taken_.insert(covered.begin(), covered.end());
    return true;
  }

 private:
  static float cross(const vec2& a, const vec2& b) { return a.x * b.y - a.y * b.x; }
  const MeshChart& chart_;
  float cells_;
  std::unordered_set<uint64_t> taken_;  // y and x of each cell
};

// Rotates the chart in its plane so that its first axis is along `direction`, and computes its
// bounds.
void turn(MeshChart& chart, const vec3& direction, const Triangles& t) {
  const vec3 along = direction - glm::dot(direction, chart.normal) * chart.normal;
  chart.tangent = glm::normalize(along);
  chart.bitangent = glm::cross(chart.normal, chart.tangent);
  chart.min = vec2(std::numeric_limits<float>::infinity());
  chart.max = -chart.min;
  for (const uint32_t i : chart.triangles) {
    for (const vec3& p : t.corners[i]) {
      chart.min = glm::min(chart.min, chart.project(p));
      chart.max = glm::max(chart.max, chart.project(p));
    }
  }
}

// The smallest rectangle around a polygon is aligned with one of its edges: tries the longest
// edges.
void turnToSmallestBox(MeshChart& chart, const Triangles& t) {
  std::vector<vec3> edges;
  for (const uint32_t i : chart.triangles)
    for (size_t k = 0; k < 3; ++k) edges.push_back(t.corners[i][(k + 1) % 3] - t.corners[i][k]);
  std::stable_sort(edges.begin(), edges.end(),
                   [](const vec3& a, const vec3& b) { return glm::dot(a, a) > glm::dot(b, b); });
  edges.resize(std::min(edges.size(), kMostEdges));
  MeshChart best = chart;
  float least = std::numeric_limits<float>::infinity();
  for (const vec3& edge : edges) {
    if (!(glm::length(glm::cross(edge, chart.normal)) > 0.0f)) continue;
    turn(chart, edge, t);
    const float area = chart.extent().x * chart.extent().y;
    if (area >= least) continue;
    least = area;
    best = chart;
  }
  chart = std::move(best);
}

}  // namespace

std::vector<MeshChart> unwrap(std::span<const vec3> positions, std::span<const uint32_t> indices,
                              float cellsPerMetre) {
  const Triangles t = trianglesOf(positions, indices);
  Bounds bounds;
  for (const uint32_t i : indices) bounds.add(positions[i]);
  std::vector<uint32_t> bySize(t.corners.size());
  std::iota(bySize.begin(), bySize.end(), 0u);
  std::stable_sort(bySize.begin(), bySize.end(),
                   [&](uint32_t a, uint32_t b) { return t.areas[a] > t.areas[b]; });
  const float extent = std::max(bounds.radius(), 1e-6f);
  const float cells = std::min(cellsPerMetre, kMostCellsOfChart / (2.0f * extent));
  const float leastCosine = std::cos(kMostBend);

  std::vector<uint8_t> isTaken(t.corners.size(), 0);
  std::vector<MeshChart> charts;
  for (const uint32_t seed : bySize) {
    if (isTaken[seed] || t.normals[seed] == vec3(0.0f)) continue;
    MeshChart& chart = charts.emplace_back();
    chart.normal = t.normals[seed];
    const Frame frame(chart.normal);
    chart.tangent = frame.tangent;
    chart.bitangent = frame.bitangent;
    Grid grid(chart, cells);
    // Adds neighbours in breadth-first order; triangles that overlap are left for another chart.
    std::deque<uint32_t> open{seed};
    std::set<uint32_t> seen{seed};
    while (!open.empty()) {
      const uint32_t next = open.front();
      open.pop_front();
      if (!grid.take(t.corners[next]) && next != seed) continue;
      isTaken[next] = 1;
      chart.triangles.push_back(next);
      for (const uint32_t n : t.neighbours[next]) {
        if (isTaken[n] || glm::dot(t.normals[n], chart.normal) < leastCosine) continue;
        if (seen.insert(n).second) open.push_back(n);
      }
    }
    std::sort(chart.triangles.begin(), chart.triangles.end());
    turnToSmallestBox(chart, t);
  }
  return charts;
}

}  // namespace lamplighter
