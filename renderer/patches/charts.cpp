#include "renderer/patches/charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "renderer/raycast/ray_caster.h"

namespace lamplighter {
namespace {

constexpr float kSameDirection = 0.99995f;  // cos 0.57°
constexpr float kLargeShare = 0.02f;        // of the object's size squared
constexpr float kLarge = 0.25f;             // m²

struct Triangle {
  std::array<uint32_t, 3> corner{};  // welded vertices
  vec3 normal{0.0f};                 // zero: it has no area
  float area = 0.0f;
};

// Vertices at the same place are one: those of a mesh are split where normals or textures break.
struct Welded {
  std::vector<vec3> positions;
  std::vector<Triangle> triangles;
};

Welded weld(const RenderScene& s, const RenderObject& o) {
  Welded out;
  std::map<std::tuple<float, float, float>, uint32_t> known;
  std::vector<uint32_t> welded(o.vertexCount);
  for (uint32_t i = 0; i < o.vertexCount; ++i) {
    const vec3& p = s.positions[o.firstVertex + i];
    const auto [it, isNew] =
        known.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(out.positions.size()));
    if (isNew) out.positions.push_back(p);
    welded[i] = it->second;
  }
  out.triangles.resize(o.triangleCount());
  for (uint32_t t = 0; t < o.triangleCount(); ++t) {
    Triangle& triangle = out.triangles[t];
    for (uint32_t c = 0; c < 3; ++c)
      triangle.corner[c] = welded[s.indices[o.firstIndex + 3 * t + c] - o.firstVertex];
    const vec3& a = out.positions[triangle.corner[0]];
    const vec3 cross =
        glm::cross(out.positions[triangle.corner[1]] - a, out.positions[triangle.corner[2]] - a);
    const float doubleArea = glm::length(cross);
    triangle.area = 0.5f * doubleArea;
    if (doubleArea > 0.0f) triangle.normal = cross / doubleArea;
  }
  return out;
}

using Edge = std::pair<uint32_t, uint32_t>;
Edge edgeOf(const Triangle& t, size_t side) {
  return std::minmax(t.corner[side], t.corner[(side + 1) % 3]);
}

// The border's vertices in order where it is one loop; empty else.
std::vector<uint32_t> borderLoop(const Welded& mesh, const std::vector<uint32_t>& triangles) {
  std::map<Edge, int> uses;
  for (const uint32_t t : triangles)
    for (size_t side = 0; side < 3; ++side) ++uses[edgeOf(mesh.triangles[t], side)];
  std::map<uint32_t, uint32_t> next;
  for (const uint32_t t : triangles) {
    const Triangle& triangle = mesh.triangles[t];
    for (size_t side = 0; side < 3; ++side) {
      if (uses[edgeOf(triangle, side)] != 1) continue;
      if (!next.try_emplace(triangle.corner[side], triangle.corner[(side + 1) % 3]).second)
        return {};  // two loops meet
    }
  }
  std::vector<uint32_t> loop;
  if (next.empty()) return loop;
  uint32_t v = next.begin()->first;
  do {
    loop.push_back(v);
    const auto it = next.find(v);
    if (it == next.end() || loop.size() > next.size()) return {};
    v = it->second;
  } while (v != loop.front());
  if (loop.size() != next.size()) loop.clear();  // there are holes
  return loop;
}

// The corners of the border, where it is convex.
std::vector<vec3> convexOutline(const Welded& mesh, const Chart& chart) {
  const std::vector<uint32_t> loop = borderLoop(mesh, chart.triangles);
  std::vector<vec3> outline;
  for (size_t i = 0; i < loop.size(); ++i) {
    const vec3& before = mesh.positions[loop[(i + loop.size() - 1) % loop.size()]];
    const vec3& here = mesh.positions[loop[i]];
    const vec3& after = mesh.positions[loop[(i + 1) % loop.size()]];
    const vec3 in = here - before, out = after - here;
    const float turn = glm::dot(glm::cross(in, out), chart.normal);
    const float tolerance = 1e-5f * glm::length(in) * glm::length(out);
    if (turn < -tolerance) return {};
    if (turn > tolerance) outline.push_back(here);
  }
  return outline.size() >= 3 ? outline : std::vector<vec3>();
}

// The frame along the longest edge, so that a rectangle's is its own.
void frame(Chart& chart, const Welded& mesh) {
  float longest = 0.0f;
  for (const uint32_t t : chart.triangles) {
    for (size_t side = 0; side < 3; ++side) {
      const Triangle& triangle = mesh.triangles[t];
      const vec3 edge =
          mesh.positions[triangle.corner[(side + 1) % 3]] - mesh.positions[triangle.corner[side]];
      // A rectangle's diagonal is longer than its sides, but two of its triangles share it.
      const float length = glm::length(edge - glm::dot(edge, chart.normal) * chart.normal);
      if (length > longest && !(chart.outline.size() >= 3)) {
        longest = length;
        chart.tangent = edge;
      }
    }
  }
  for (size_t i = 0; i < chart.outline.size(); ++i) {
    const vec3 edge = chart.outline[(i + 1) % chart.outline.size()] - chart.outline[i];
    if (glm::length(edge) <= longest) continue;
    longest = glm::length(edge);
    chart.tangent = edge;
  }
  chart.tangent -= glm::dot(chart.tangent, chart.normal) * chart.normal;
  chart.tangent = glm::normalize(chart.tangent);
  chart.bitangent = glm::cross(chart.normal, chart.tangent);
}

Chart chartOf(const Welded& mesh, uint32_t object, std::vector<uint32_t> triangles,
              const vec3& normal) {
  Chart chart;
  chart.object = object;
  chart.triangles = std::move(triangles);
  std::sort(chart.triangles.begin(), chart.triangles.end());
  chart.normal = normal;
  chart.origin = mesh.positions[mesh.triangles[chart.triangles.front()].corner[0]];
  chart.outline = convexOutline(mesh, chart);
  frame(chart, mesh);
  chart.min = vec2(std::numeric_limits<float>::infinity());
  chart.max = -chart.min;
  for (const uint32_t t : chart.triangles) {
    chart.area += mesh.triangles[t].area;
    for (const uint32_t v : mesh.triangles[t].corner) {
      const vec3& p = mesh.positions[v];
      chart.thickness =
          std::max(chart.thickness, std::abs(glm::dot(p - chart.origin, chart.normal)));
      chart.min = glm::min(chart.min, chart.project(p));
      chart.max = glm::max(chart.max, chart.project(p));
    }
  }
  return chart;
}

}  // namespace

std::vector<Chart> findCharts(const RenderScene& scene, uint32_t object) {
  const RenderObject& o = scene.objects[object];
  const Welded mesh = weld(scene, o);
  const float size = glm::length(o.bounds.extent());

  std::map<Edge, std::vector<uint32_t>> atEdge;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (size_t side = 0; side < 3; ++side) atEdge[edgeOf(mesh.triangles[t], side)].push_back(t);

  // Charts grow from the largest triangles, whose planes are known best.
  std::vector<uint32_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return mesh.triangles[a].area > mesh.triangles[b].area;
  });
  std::vector<Chart> charts;
  std::vector<bool> taken(mesh.triangles.size(), false);
  for (const uint32_t seed : order) {
    const Triangle& first = mesh.triangles[seed];
    if (taken[seed] || first.area <= 0.0f) continue;
    const vec3& origin = mesh.positions[first.corner[0]];
    const float tolerance = rayEpsilon(o.bounds.max) + rayEpsilon(o.bounds.min);
    const auto liesInPlane = [&](const Triangle& t) {
      if (t.area > 0.0f && glm::dot(t.normal, first.normal) < kSameDirection) return false;
      return std::all_of(t.corner.begin(), t.corner.end(), [&](uint32_t v) {
        return std::abs(glm::dot(mesh.positions[v] - origin, first.normal)) <= tolerance;
      });
    };
    std::vector<uint32_t> members{seed};
    taken[seed] = true;
    for (size_t i = 0; i < members.size(); ++i) {
      for (size_t side = 0; side < 3; ++side) {
        for (const uint32_t t : atEdge[edgeOf(mesh.triangles[members[i]], side)]) {
          if (taken[t] || !liesInPlane(mesh.triangles[t])) continue;
          taken[t] = true;
          members.push_back(t);
        }
      }
    }
    float area = 0.0f;
    for (const uint32_t t : members) area += mesh.triangles[t].area;
    // What is too small to be one is not asked again: a chart that it could be part of would have
    // had it now.
    if (area >= std::min(kLarge, kLargeShare * size * size))
      charts.push_back(chartOf(mesh, object, std::move(members), first.normal));
  }
  return charts;
}

}  // namespace lamplighter
