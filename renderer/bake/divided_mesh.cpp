#include "renderer/bake/divided_mesh.h"

#include <algorithm>
#include <utility>

#include "renderer/surface_light/triangle_division.h"

namespace lamplighter {
namespace {

uint64_t keyOfPair(uint32_t a, uint32_t b) {
  return uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

// The mean of two vertices, appended.
void appendMean(Primitive& p, uint32_t a, uint32_t b) {
  const auto mean = [&](auto& values) {
    if (!values.empty()) values.push_back(0.5f * (values[a] + values[b]));
  };
  const auto unit = [](const vec3& sum, const vec3& fallback) {
    const float length = glm::length(sum);
    return length > 1e-6f ? sum / length : fallback;
  };
  mean(p.positions), mean(p.uv0), mean(p.uv1), mean(p.colors);
  p.normals.push_back(unit(p.normals[a] + p.normals[b], p.normals[std::min(a, b)]));
  if (p.tangents.empty()) return;
  const vec4 &ta = p.tangents[a], &tb = p.tangents[b];
  p.tangents.push_back(vec4(unit(vec3(ta) + vec3(tb), vec3(ta)), ta.w));
}

// Whether the second way to divide the rest beside the cut corner has the shorter diagonal.
// `corners`: three corners and three midpoints.
bool wantsDiagonal(int edges, const std::array<vec3, 6>& corners) {
  const auto length = [&](size_t a, size_t b) { return glm::distance(corners[a], corners[b]); };
  switch (edges) {
    case 3:
      return length(3, 2) < length(0, 4);
    case 6:
      return length(1, 5) < length(0, 4);
    case 5:
      return length(1, 5) < length(3, 2);
    default:
      return false;
  }
}

}  // namespace

DividedMesh::DividedMesh(const Mesh& mesh, std::span<const NodeMesh::Part> parts) {
  for (uint32_t i = 0; i < parts.size(); ++i) {
    Part& part = parts_.emplace_back();
    part.vertices = mesh.primitives[parts[i].primitive];
    const std::vector<uint32_t>& indices = part.vertices.indices;
    part.points.assign(part.vertices.positions.size(), 0);
    for (uint32_t t = 0; t < indices.size() / 3; ++t) {
      Triangle& triangle = part.triangles.emplace_back();
      triangle.source = t;
      for (uint32_t c = 0; c < 3; ++c) {
        triangle.vertices[c] = indices[3 * t + c];
        triangle.weights[c] = vec3(0.0f);
        triangle.weights[c][static_cast<int>(c)] = 1.0f;
        add(i, triangle.vertices[c], {i, t, triangle.weights[c]});
      }
    }
  }
}

void DividedMesh::add(size_t part, uint32_t vertex, const SourcePlace& place) {
  const Primitive& p = parts_[part].vertices;
  const auto [id, isNew] = pointKeys_.find(p.positions[vertex], p.normals[vertex]);
  if (isNew)
    points_.push_back(
        {p.positions[vertex], siteKeys_.find(p.positions[vertex], vec3(0.0f)).first, {}});
  if (parts_[part].points.size() <= vertex) parts_[part].points.resize(vertex + 1);
  parts_[part].points[vertex] = id;
  if (points_[id].places.size() < kPlaces) points_[id].places.push_back(place);
}

uint64_t DividedMesh::edgeOf(uint32_t pointA, uint32_t pointB) const {
  return keyOfPair(points_[pointA].site, points_[pointB].site);
}

uint32_t DividedMesh::midpoint(size_t part, uint32_t a, uint32_t b, const SourcePlace& place) {
  Primitive& p = parts_[part].vertices;
  const auto [it, isNew] =
      midpoints_.emplace(keyOfPair(a, b), static_cast<uint32_t>(p.positions.size()));
  if (isNew) appendMean(p, a, b);
  add(part, it->second, place);
  return it->second;
}

bool DividedMesh::divide(const Edges& edges) {
  bool isDivided = false;
  for (uint32_t i = 0; i < parts_.size(); ++i) {
    midpoints_.clear();
    std::vector<Triangle> before = std::exchange(parts_[i].triangles, {});
    for (Triangle& t : before) {
      t.isNew = false;
      int bits = 0;
      std::array<uint32_t, 6> vertices{t.vertices[0], t.vertices[1], t.vertices[2]};
      std::array<vec3, 6> weights{t.weights[0], t.weights[1], t.weights[2]};
      for (size_t e = 0; e < 3; ++e) {
        const auto [a, b] = kEdgeCorners[e];
        const std::vector<uint32_t>& points = parts_[i].points;
        if (!edges.contains(edgeOf(points[vertices[a]], points[vertices[b]]))) continue;
        bits |= 1 << e;
        weights[3 + e] = 0.5f * (weights[a] + weights[b]);
        vertices[3 + e] = midpoint(i, vertices[a], vertices[b], {i, t.source, weights[3 + e]});
      }
      if (bits == 0) {
        parts_[i].triangles.push_back(t);
        continue;
      }
      isDivided = true;
      std::array<vec3, 6> corners{};
      for (size_t c = 0; c < 6; ++c) corners[c] = parts_[i].vertices.positions[vertices[c]];
      const TriangleDivision& division =
          triangleDivision(divisionOf(bits, wantsDiagonal(bits, corners)));
      for (size_t k = 0; k < static_cast<size_t>(division.count); ++k) {
        Triangle child{t.source, {}, {}, true};
        for (size_t c = 0; c < 3; ++c) {
          child.vertices[c] = vertices[division.children[k][c]];
          child.weights[c] = weights[division.children[k][c]];
        }
        parts_[i].triangles.push_back(child);
      }
    }
  }
  return isDivided;
}

Primitive DividedMesh::primitiveOf(size_t part) const {
  Primitive p = parts_[part].vertices;
  p.indices.clear();
  for (const Triangle& t : parts_[part].triangles)
    p.indices.insert(p.indices.end(), t.vertices.begin(), t.vertices.end());
  return p;
}

}  // namespace lamplighter
