#include "renderer/patches/topology.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "renderer/patches/triangle_order.h"
#include "renderer/raycast/ray_caster.h"

namespace lamplighter {
namespace {

constexpr float kSameDirection = 0.99995f;  // cos 0.57°
constexpr float kRoughDirection = 0.9976f;  // cos 4°
constexpr float kRoughShare = 0.0005f;      // of the object's size: largest height of bumps
constexpr int kMostFits = 12;               // iterations of fitting a plane
constexpr float kLargeShare = 0.02f;        // of the object's size squared

// Triangles with an area for which `takes` holds, from the largest to the smallest.
template <typename Takes>
std::vector<uint32_t> bySize(const MeshShape& shape, const Takes& takes) {
  std::vector<uint64_t> keys;
  for (uint32_t t = 0; t < shape.triangles(); ++t)
    if (shape.area(t) > 0.0f && takes(t))
      keys.push_back(uint64_t{~std::bit_cast<uint32_t>(shape.area(t))} << 32 | t);
  std::sort(keys.begin(), keys.end());
  std::vector<uint32_t> order;
  order.reserve(keys.size());
  for (const uint64_t key : keys) order.push_back(static_cast<uint32_t>(key));
  return order;
}

// The vertices of the border in order if it is a single loop; otherwise empty.
std::vector<uint32_t> borderLoop(const MeshShape& shape, const std::vector<uint32_t>& triangles) {
  std::vector<MeshShape::Side> sides, border;
  for (const uint32_t t : triangles)
    for (const MeshShape::Side& s : shape.sides(t)) sides.push_back(s);
  const auto ends = [](const MeshShape::Side& s) { return std::minmax(s.from, s.to); };
  std::sort(sides.begin(), sides.end(),
            [&](const MeshShape::Side& a, const MeshShape::Side& b) { return ends(a) < ends(b); });
  for (size_t i = 0, next; i < sides.size(); i = next) {
    for (next = i + 1; next < sides.size() && ends(sides[next]) == ends(sides[i]);) ++next;
    if (next == i + 1) border.push_back(sides[i]);
  }
  const auto isBefore = [](const MeshShape::Side& s, int from) { return s.from < from; };
  std::sort(border.begin(), border.end(), [&](const MeshShape::Side& a, const MeshShape::Side& b) {
    return isBefore(a, b.from);
  });
  const auto meet = [](const MeshShape::Side& a, const MeshShape::Side& b) {
    return a.from == b.from;
  };
  if (border.empty() || std::adjacent_find(border.begin(), border.end(), meet) != border.end())
    return {};  // two loops meet
  std::vector<uint32_t> loop;
  const int start = border.front().from;
  int v = start;
  do {
    const auto it = std::lower_bound(border.begin(), border.end(), v, isBefore);
    if (it == border.end() || it->from != v || loop.size() >= border.size()) return {};
    loop.push_back(it->fromVertex);
    v = it->to;
  } while (v != start);
  if (loop.size() != border.size()) loop.clear();  // there are holes
  return loop;
}

// The corners of the border if it is convex.
std::vector<uint32_t> convexOutline(const MeshShape& shape, const ChartTopology& chart) {
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
std::array<uint32_t, 2> longestEdge(const MeshShape& shape, const ChartTopology& chart) {
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
    for (const MeshShape::Side& s : shape.sides(t)) offer(s.fromVertex, s.toVertex);
  return best;
}

// Finds charts with an area of at least `least` [m²], or at least a fraction of the object's size
// squared.
void findCharts(const MeshShape& shape, float least, std::vector<ChartTopology>& charts,
                std::vector<bool>& taken) {
  // Charts grow from the largest triangles, whose planes are the most precise.
  const std::vector<uint32_t> order = bySize(shape, [](uint32_t) { return true; });
  const float size = glm::length(shape.bounds().extent());
  const float tolerance = rayEpsilon(shape.bounds().max) + rayEpsilon(shape.bounds().min);
  std::vector<bool> tried(shape.triangles(), false);
  for (const uint32_t seed : order) {
    if (tried[seed]) continue;
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

// Whether a triangle is in a connected part of the remaining ones that is as large as a rough
// chart.
std::vector<bool> inLargeParts(const MeshShape& shape, float least,
                               const std::vector<bool>& taken) {
  std::vector<bool> isLarge(shape.triangles(), false), seen = taken;
  std::vector<uint32_t> part;
  for (uint32_t first = 0; first < shape.triangles(); ++first) {
    if (seen[first]) continue;
    seen[first] = true;
    part.assign(1, first);
    double area = 0.0;
    for (size_t i = 0; i < part.size(); ++i) {
      area += static_cast<double>(shape.area(part[i]));
      for (const int n : shape.neighbours(part[i])) {
        if (n < 0 || seen[static_cast<size_t>(n)]) continue;
        seen[static_cast<size_t>(n)] = true;
        part.push_back(static_cast<uint32_t>(n));
      }
    }
    // With a margin for the rounding errors of sums.
    if (area < 0.999 * static_cast<double>(least)) continue;
    for (const uint32_t t : part) isLarge[t] = true;
  }
  return isLarge;
}

// Finds rough charts in the remaining triangles: parts that are planar except for small bumps. One
// triangle does not define the plane precisely. So the plane is fitted repeatedly to all triangles
// near it, until no more are added.
void findRoughCharts(const MeshShape& shape, const TopologyLimits& limits,
                     std::vector<ChartTopology>& charts, std::vector<bool>& taken) {
  const std::vector<bool> mayBe = inLargeParts(shape, limits.largeRough, taken);
  const std::vector<uint32_t> order =
      bySize(shape, [&](uint32_t t) { return !taken[t] && mayBe[t]; });
  if (order.empty()) return;
  const float size = glm::length(shape.bounds().extent());
  const float tolerance = std::min(limits.rough, kRoughShare * size);
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
    if (area < limits.largeRough) continue;
    ChartTopology& chart = charts.emplace_back();
    chart.seed = seed;
    chart.isRough = true;
    chart.triangles = std::move(members);
    std::sort(chart.triangles.begin(), chart.triangles.end());
    for (const uint32_t t : chart.triangles) taken[t] = true;
    chart.longestEdge = longestEdge(shape, chart);
  }
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

MeshTopology findTopology(const RenderScene& scene, uint32_t object, const TopologyLimits& limits) {
  const RenderObject& o = scene.objects[object];
  MeshTopology out;
  out.shape = shapeOf(o);
  MeshShape shape(scene, o, out.shape.scale);
  std::vector<bool> taken(o.triangleCount(), false);
  if (o.kind != MeshKind::complex) {
    shape.connect();
    findCharts(shape, o.kind == MeshKind::simple ? 0.0f : limits.large, out.charts, taken);
  }
  if (o.kind == MeshKind::automatic) findRoughCharts(shape, limits, out.charts, taken);
  for (uint32_t t = 0; t < o.triangleCount(); ++t)
    if (!taken[t]) out.loose.push_back(t);
  sortLoose(shape, limits.smallestCluster, out);
  addOccluders(shape, out);
  return out;
}

}  // namespace lamplighter
