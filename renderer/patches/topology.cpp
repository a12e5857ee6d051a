#include "renderer/patches/topology.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <span>
#include <tuple>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "renderer/raycast/ray_caster.h"

namespace lamplighter {
namespace {

constexpr float kSameDirection = 0.99995f;  // cos 0.57°
constexpr float kRoughDirection = 0.9976f;  // cos 4°
constexpr float kRough = 0.0025f;           // m, on both sides of the plane
constexpr float kRoughShare = 0.0005f;      // and as a fraction of the object's size
constexpr float kLargeRough = 1.0f;         // m²: no bent surface has so large a part near a plane
constexpr int kMostFits = 12;               // iterations of fitting a plane
constexpr float kLargeShare = 0.02f;        // of the object's size squared
constexpr float kLarge = 0.25f;             // m²
constexpr size_t kClusterTriangles = 1024;  // larger clusters are halved
constexpr float kSmallestCluster = 2.0f;    // if they are larger than this [m]

constexpr size_t kNoCluster = static_cast<size_t>(-1);

struct MeshTraits : OpenMesh::DefaultTraits {
  VertexAttributes(0);
  HalfedgeAttributes(0);
  EdgeAttributes(0);
  FaceAttributes(0);
};
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;

// The object's triangles in object space: its own vertices, scaled but not rotated or moved. In a
// mirrored object they show their back faces here.
class Shape {
 public:
  Shape(const RenderScene& s, const RenderObject& o) : count_(o.triangleCount()) {
    const ShapeKey key = shapeOf(o);
    positions_.reserve(o.vertexCount);
    for (uint32_t i = 0; i < o.vertexCount; ++i) {
      positions_.push_back(s.localPositions[o.firstVertex + i] * key.scale);
      bounds_.add(positions_.back());
    }
    corners_.reserve(size_t{3} * count_);
    for (uint32_t i = 0; i < o.indexCount; ++i)
      corners_.push_back(s.indices[o.firstIndex + i] - o.firstVertex);
    normals_.resize(count_, vec3(0.0f));
    areas_.resize(count_, 0.0f);
    for (uint32_t t = 0; t < count_; ++t) {
      const vec3 &a = at(t, 0), &b = at(t, 1), &c = at(t, 2);
      const vec3 cross = glm::cross(b - a, c - a);
      const float doubleArea = glm::length(cross);
      areas_[t] = 0.5f * doubleArea;
      if (doubleArea > 0.0f) normals_[t] = cross / doubleArea;
    }
    join();
  }

  uint32_t triangles() const { return count_; }
  const Bounds& bounds() const { return bounds_; }
  float area(uint32_t t) const { return areas_[t]; }
  const vec3& normal(uint32_t t) const { return normals_[t]; }  // zero: the triangle has no area
  uint32_t vertex(uint32_t t, size_t corner) const { return corners_[size_t{3} * t + corner]; }
  const vec3& at(uint32_t t, size_t corner) const { return positions_[vertex(t, corner)]; }
  const vec3& position(uint32_t vertex) const { return positions_[vertex]; }

  // The triangle across each edge; kNone at a border.
  std::array<int, 3> neighbours(uint32_t t) const {
    std::array<int, 3> out;
    size_t side = 0;
    for (const auto h : mesh_.fh_range(mesh_.face_handle(t)))
      out[side++] = mesh_.opposite_face_handle(h).idx();
    return out;
  }
  // An edge: its two welded vertices, and a vertex of the triangle at each.
  struct Side {
    int from, to;
    uint32_t fromVertex, toVertex;
  };
  std::array<Side, 3> sides(uint32_t t) const {
    std::array<Side, 3> out;
    for (size_t i = 0; i < 3; ++i) {
      const size_t next = (i + 1) % 3;
      out[i] = {welded_[vertex(t, i)], welded_[vertex(t, next)], vertex(t, i), vertex(t, next)};
    }
    return out;
  }

 private:
  // Welds vertices with equal positions, because meshes are split where normals or textures are
  // discontinuous. Triangles that OpenMesh cannot connect, because three meet at an edge, stay
  // separate.
  void join() {
    // Faces that cannot be connected are expected; suppress OpenMesh's messages on standard error.
    static std::once_flag isQuiet;
    std::call_once(isQuiet, [] { omerr().disable(); });
    std::map<std::tuple<float, float, float>, int> known;
    welded_.resize(positions_.size());
    for (size_t i = 0; i < positions_.size(); ++i) {
      const vec3& p = positions_[i];
      const auto [it, isNew] = known.try_emplace({p.x, p.y, p.z}, static_cast<int>(known.size()));
      if (isNew) mesh_.add_vertex({p.x, p.y, p.z});
      welded_[i] = it->second;
    }
    for (uint32_t t = 0; t < count_; ++t) {
      std::array<OpenMesh::VertexHandle, 3> v;
      for (size_t c = 0; c < 3; ++c)
        v[c] = mesh_.vertex_handle(static_cast<uint32_t>(welded_[vertex(t, c)]));
      const bool degenerate = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
      if (!degenerate && canJoin(v) && mesh_.add_face(v[0], v[1], v[2]).is_valid()) continue;
      for (size_t c = 0; c < 3; ++c) {
        const vec3& p = at(t, c);
        v[c] = mesh_.add_vertex({p.x, p.y, p.z});
      }
      mesh_.add_face(v[0], v[1], v[2]);
    }
  }

  // Whether all three edges are free.
  bool canJoin(const std::array<OpenMesh::VertexHandle, 3>& v) const {
    for (size_t c = 0; c < 3; ++c) {
      if (!mesh_.is_boundary(v[c])) return false;
      const auto h = mesh_.find_halfedge(v[c], v[(c + 1) % 3]);
      if (h.is_valid() && !mesh_.is_boundary(h)) return false;
    }
    return true;
  }

  uint32_t count_;
  std::vector<vec3> positions_;
  std::vector<uint32_t> corners_;
  std::vector<int> welded_;  // by vertex
  std::vector<vec3> normals_;
  std::vector<float> areas_;
  Bounds bounds_;
  TriMesh mesh_;  // face t is triangle t
};

// The vertices of the border in order if it is a single loop; otherwise empty.
std::vector<uint32_t> borderLoop(const Shape& shape, const std::vector<uint32_t>& triangles) {
  std::map<std::pair<int, int>, int> uses;
  for (const uint32_t t : triangles)
    for (const Shape::Side& s : shape.sides(t)) ++uses[std::minmax(s.from, s.to)];
  struct Step {
    int to;
    uint32_t vertex;
  };
  std::map<int, Step> next;
  for (const uint32_t t : triangles) {
    for (const Shape::Side& s : shape.sides(t)) {
      if (uses[std::minmax(s.from, s.to)] != 1) continue;
      if (!next.try_emplace(s.from, Step{s.to, s.fromVertex}).second) return {};  // two loops meet
    }
  }
  std::vector<uint32_t> loop;
  if (next.empty()) return loop;
  const int start = next.begin()->first;
  int v = start;
  do {
    const auto it = next.find(v);
    if (it == next.end() || loop.size() >= next.size()) return {};
    loop.push_back(it->second.vertex);
    v = it->second.to;
  } while (v != start);
  if (loop.size() != next.size()) loop.clear();  // there are holes
  return loop;
}

// The corners of the border if it is convex.
std::vector<uint32_t> convexOutline(const Shape& shape, const ChartTopology& chart) {
  const std::vector<uint32_t> loop = borderLoop(shape, chart.triangles);
  const vec3& normal = shape.normal(chart.seed);
  std::vector<uint32_t> outline;
  for (size_t i = 0; i < loop.size(); ++i) {
    const vec3& before = shape.position(loop[(i + loop.size() - 1) % loop.size()]);
    const vec3& here = shape.position(loop[i]);
    const vec3& after = shape.position(loop[(i + 1) % loop.size()]);
    const vec3 in = here - before, out = after - here;
    const float turn = glm::dot(glm::cross(in, out), normal);
    const float tolerance = 1e-5f * glm::length(in) * glm::length(out);
    if (turn < -tolerance) return {};
    if (turn > tolerance) outline.push_back(loop[i]);
  }
  return outline.size() >= 3 ? outline : std::vector<uint32_t>();
}

// Longest edge of the outline, so that a rectangle gets one of its sides; without an outline, of
// all triangles.
std::array<uint32_t, 2> longestEdge(const Shape& shape, const ChartTopology& chart) {
  std::array<uint32_t, 2> best{};
  float longest = 0.0f;
  const auto offer = [&](uint32_t a, uint32_t b) {
    const float length = glm::length(shape.position(b) - shape.position(a));
    if (length <= longest) return;
    longest = length;
    best = {a, b};
  };
  for (size_t i = 0; i < chart.outline.size(); ++i)
    offer(chart.outline[i], chart.outline[(i + 1) % chart.outline.size()]);
  if (!chart.outline.empty()) return best;
  for (const uint32_t t : chart.triangles)
    for (const Shape::Side& s : shape.sides(t)) offer(s.fromVertex, s.toVertex);
  return best;
}

// Finds charts with an area of at least `least` [m²], or at least a fraction of the object's size
// squared.
void findCharts(const Shape& shape, float least, std::vector<ChartTopology>& charts,
                std::vector<bool>& taken) {
  // Charts grow from the largest triangles, whose planes are the most precise.
  std::vector<uint32_t> order(shape.triangles());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return shape.area(a) > shape.area(b); });
  const float size = glm::length(shape.bounds().extent());
  const float tolerance = rayEpsilon(shape.bounds().max) + rayEpsilon(shape.bounds().min);
  std::vector<bool> tried(shape.triangles(), false);
  for (const uint32_t seed : order) {
    if (tried[seed] || shape.area(seed) <= 0.0f) continue;
    const vec3 &origin = shape.at(seed, 0), &normal = shape.normal(seed);
    const auto liesInPlane = [&](uint32_t t) {
      if (shape.area(t) > 0.0f && glm::dot(shape.normal(t), normal) < kSameDirection) return false;
      for (size_t c = 0; c < 3; ++c)
        if (std::abs(glm::dot(shape.at(t, c) - origin, normal)) > tolerance) return false;
      return true;
    };
    std::vector<uint32_t> members{seed};
    tried[seed] = true;
    for (size_t i = 0; i < members.size(); ++i) {
      for (const int t : shape.neighbours(members[i])) {
        if (t < 0 || tried[static_cast<size_t>(t)] || !liesInPlane(static_cast<uint32_t>(t)))
          continue;
        tried[static_cast<size_t>(t)] = true;
        members.push_back(static_cast<uint32_t>(t));
      }
    }
    float area = 0.0f;
    for (const uint32_t t : members) area += shape.area(t);
    // The triangles of a part that is too small are not tried again: a larger chart that contains
    // them would have been found now.
    if (area < std::min(least, kLargeShare * size * size)) continue;
    ChartTopology& chart = charts.emplace_back();
    chart.seed = seed;
    chart.triangles = std::move(members);
    std::sort(chart.triangles.begin(), chart.triangles.end());
    for (const uint32_t t : chart.triangles) taken[t] = true;
    chart.outline = convexOutline(shape, chart);
    chart.longestEdge = longestEdge(shape, chart);
  }
}

// Finds rough charts in the remaining triangles: parts that are planar except for small bumps. One
// triangle does not define the plane precisely. So the plane is fitted repeatedly to all triangles
// near it, until no more are added.
void findRoughCharts(const Shape& shape, std::vector<ChartTopology>& charts,
                     std::vector<bool>& taken) {
  std::vector<uint32_t> order;
  for (uint32_t t = 0; t < shape.triangles(); ++t)
    if (!taken[t] && shape.area(t) > 0.0f) order.push_back(t);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return shape.area(a) > shape.area(b); });
  const float size = glm::length(shape.bounds().extent());
  const float tolerance = std::min(kRough, kRoughShare * size);
  std::vector<uint32_t> found(shape.triangles(), 0);  // index of the search that found the triangle
  std::vector<bool> tried = taken;
  uint32_t search = 0;
  for (const uint32_t seed : order) {
    if (tried[seed]) continue;
    vec3 normal = shape.normal(seed);
    vec3 origin = (shape.at(seed, 0) + shape.at(seed, 1) + shape.at(seed, 2)) / 3.0f;
    std::vector<uint32_t> members;
    for (int fit = 0; fit < kMostFits; ++fit) {
      const auto liesNear = [&](uint32_t t) {
        if (taken[t]) return false;
        if (shape.area(t) > 0.0f && glm::dot(shape.normal(t), normal) < kRoughDirection)
          return false;
        for (size_t c = 0; c < 3; ++c)
          if (std::abs(glm::dot(shape.at(t, c) - origin, normal)) > tolerance) return false;
        return true;
      };
      std::vector<uint32_t> near;
      ++search;
      if (liesNear(seed)) near.push_back(seed);
      found[seed] = search;
      for (size_t i = 0; i < near.size(); ++i) {
        for (const int n : shape.neighbours(near[i])) {
          if (n < 0 || found[static_cast<size_t>(n)] == search) continue;
          found[static_cast<size_t>(n)] = search;
          if (liesNear(static_cast<uint32_t>(n))) near.push_back(static_cast<uint32_t>(n));
        }
      }
      if (near.size() <= members.size()) break;
      members = std::move(near);
      vec3 sum(0.0f), middle(0.0f);
      float area = 0.0f;
      for (const uint32_t t : members) {
        sum += shape.area(t) * shape.normal(t);
        middle += shape.area(t) * (shape.at(t, 0) + shape.at(t, 1) + shape.at(t, 2)) / 3.0f;
        area += shape.area(t);
      }
      normal = glm::normalize(sum);
      origin = middle / area;
    }
    float area = 0.0f;
    for (const uint32_t t : members) {
      tried[t] = true;
      area += shape.area(t);
    }
    tried[seed] = true;
    if (area < kLargeRough) continue;
    ChartTopology& chart = charts.emplace_back();
    chart.seed = seed;
    chart.isRough = true;
    chart.triangles = std::move(members);
    std::sort(chart.triangles.begin(), chart.triangles.end());
    for (const uint32_t t : chart.triangles) taken[t] = true;
    chart.longestEdge = longestEdge(shape, chart);
  }
}

// Sorts the triangles into the order of a tree that splits at the median of their centres along the
// longest axis. Makes clusters of its first levels.
void sortLoose(const Shape& shape, MeshTopology& out, uint32_t first, uint32_t count,
               size_t cluster) {
  if (count <= kGroupTriangles) return;
  const std::span<uint32_t> triangles(&out.loose[first], count);
  Bounds box;
  for (const uint32_t t : triangles)
    for (size_t c = 0; c < 3; ++c) box.add(shape.at(t, c));
  const vec3 size = box.extent();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto middle = [&](uint32_t t) {
    return shape.at(t, 0)[axis] + shape.at(t, 1)[axis] + shape.at(t, 2)[axis];
  };
  std::stable_sort(triangles.begin(), triangles.end(),
                   [&](uint32_t a, uint32_t b) { return middle(a) < middle(b); });
  // The left half consists of whole groups, so that no group is split.
  const uint32_t half = (count / 2 + kGroupTriangles - 1) / kGroupTriangles * kGroupTriangles;
  const bool divides =
      cluster != kNoCluster && count > kClusterTriangles && size[axis] > kSmallestCluster;
  const size_t children = divides ? out.clusters.size() : kNoCluster;
  if (divides) {
    out.clusters[cluster].firstChild = static_cast<int>(children);
    out.clusters.push_back({first, half, kNone});
    out.clusters.push_back({first + half, count - half, kNone});
  }
  sortLoose(shape, out, first, half, children);
  sortLoose(shape, out, first + half, count - half, divides ? children + 1 : kNoCluster);
}

// Makes the boxes for occluder searches: triangles of charts one by one, loose triangles in groups.
void findOccluders(const Shape& shape, MeshTopology& out) {
  std::vector<Bounds> boxes;
  const auto add = [&](uint32_t t) {
    for (size_t c = 0; c < 3; ++c) boxes.back().add(shape.at(t, c));
  };
  for (const ChartTopology& chart : out.charts) {
    for (const uint32_t t : chart.triangles) {
      out.flat.push_back(t);
      boxes.emplace_back();
      add(t);
    }
  }
  for (size_t i = 0; i < out.loose.size(); ++i) {
    if (i % kGroupTriangles == 0) boxes.emplace_back();
    add(out.loose[i]);
  }
  out.occluders = BoundsTree(boxes);
}

}  // namespace

ShapeKey shapeOf(const RenderObject& object) {
  ShapeKey key;
  for (int c = 0; c < 3; ++c) {
    int exponent = 0;
    const float part = std::frexp(glm::length(vec3(object.world[c])), &exponent);
    key.scale[c] = std::ldexp(std::round(part * 1024.0f) / 1024.0f, exponent);
  }
  key.kind = object.kind;
  key.mirrored = glm::determinant(mat3(object.world)) < 0.0f;
  return key;
}

MeshTopology findTopology(const RenderScene& scene, uint32_t object) {
  const RenderObject& o = scene.objects[object];
  const Shape shape(scene, o);
  MeshTopology out;
  out.shape = shapeOf(o);
  std::vector<bool> taken(o.triangleCount(), false);
  if (o.kind != MeshKind::complex)
    findCharts(shape, o.kind == MeshKind::simple ? 0.0f : kLarge, out.charts, taken);
  if (o.kind == MeshKind::automatic) findRoughCharts(shape, out.charts, taken);
  for (uint32_t t = 0; t < o.triangleCount(); ++t)
    if (!taken[t]) out.loose.push_back(t);
  if (!out.loose.empty()) {
    const auto count = static_cast<uint32_t>(out.loose.size());
    out.clusters.push_back({0, count, kNone});
    sortLoose(shape, out, 0, count, 0);
  }
  findOccluders(shape, out);
  return out;
}

}  // namespace lamplighter
