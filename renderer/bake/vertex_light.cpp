#include "renderer/bake/vertex_light.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"

namespace lamplighter {
namespace {

// Light is found so far from the border of a triangle [m], at most this share of the way to its
// middle, because a vertex may lie on an adjacent wall.
constexpr float kInwards = 0.02f;
constexpr float kMostInwards = 0.1f;
// Maximum distance of the points of an edge at which contrast is tested, in shortest edges.
constexpr float kTestEdges = 4.0f;
constexpr int kMostIntervals = 64;     // along an edge
constexpr int kMostTriangleRows = 16;  // inside of a triangle

constexpr float kLeastHeight = 1e-4f;  // of a triangle, as a share of its longest edge

bool isKnown(const vec3& light) { return light.x >= 0.0f; }

uint64_t pairOf(uint32_t a, uint32_t b) { return uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

// Number of equal parts of a length, a power of two.
int intervalsOf(float length, float longest, int most) {
  int n = 2;
  while (n < most && length > longest * static_cast<float>(n)) n *= 2;
  return n;
}

}  // namespace

// An edge whose contrast was not tested before.
struct VertexLight::EdgeTest {
  std::array<uint32_t, 2> points{};
  SourcePlace from, to;  // its ends in one triangle
  float length = 0.0f;
};

VertexLight::VertexLight(const RenderScene& scene, const BakedLight& light, const Mesh& mesh,
                         const NodeMesh& node)
    : scene_(scene),
      light_(light),
      source_(mesh),
      node_(node),
      world_(scene.objects[node.parts.front().object].world),
      mesh_(mesh, node.parts) {
  findNewLight();
}

VertexLight::Sum VertexLight::sum() const {
  Sum out;
  for (const vec3& v : values_) {
    if (!isKnown(v)) continue;
    out.light += static_cast<double>(v.r + v.g + v.b) / 3.0;
    ++out.count;
  }
  return out;
}

vec3 VertexLight::lightAt(const SourcePlace& place, uint32_t number) const {
  const uint32_t object = node_.parts[place.part].object;
  const RenderObject& o = scene_.objects[object];
  const uint32_t* index = &scene_.indices[o.firstIndex + 3 * place.triangle];
  vec3 w = place.weights;
  // The scene reverses the triangles of mirrored nodes.
  const Primitive& p = source_.primitives[node_.parts[place.part].primitive];
  if (index[1] - o.firstVertex != p.indices[3 * place.triangle + 1]) std::swap(w.y, w.z);
  const vec3 &a = scene_.positions[index[0]], &b = scene_.positions[index[1]],
             &c = scene_.positions[index[2]];
  if (glm::cross(b - a, c - a) == vec3(0.0f)) return vec3(-1.0f);  // it receives no light
  const vec3 middle(1.0f / 3.0f);
  const float way = glm::distance(w.x * a + w.y * b + w.z * c, (a + b + c) / 3.0f);
  w = glm::mix(w, middle, way > 0.0f ? std::min(kMostInwards, kInwards / way) : 0.0f);
  const BakePoint point{0, 0, object, place.triangle, w.y, w.z};
  return light_.irradiance(std::span(&point, 1), hash4(number, object, place.triangle, 0));
}

vec3 VertexLight::lightAt(const DividedMesh::Point& point, uint32_t number) const {
  vec3 sum(0.0f);
  float count = 0.0f;
  for (const SourcePlace& place : point.places) {
    const vec3 light = lightAt(place, number);
    if (!isKnown(light)) continue;
    sum += light;
    count += 1.0f;
  }
  return count > 0.0f ? sum / count : vec3(-1.0f);
}

void VertexLight::findNewLight() {
  const size_t first = values_.size();
  values_.resize(mesh_.points().size());
  tbb::parallel_for(first, values_.size(), [&](size_t i) {
    values_[i] = lightAt(mesh_.points()[i], static_cast<uint32_t>(i));
  });
}

float VertexLight::lengthOf(uint32_t a, uint32_t b) const {
  return glm::length(world_ * (mesh_.points()[b].position - mesh_.points()[a].position));
}

VertexLight::Size VertexLight::sizeOf(const std::array<uint32_t, 3>& points) const {
  const auto at = [&](size_t c) { return world_ * mesh_.points()[points[c]].position; };
  const vec3 ab = at(1) - at(0), ac = at(2) - at(0);
  const float longest = std::max({glm::length(ab), glm::length(ac), glm::length(ac - ab)});
  return {longest, longest > 0.0f ? glm::length(glm::cross(ab, ac)) / longest : 0.0f};
}

bool VertexLight::isCoarse(const vec3& found, const vec3& interpolated) const {
  const auto largest = [](const vec3& v) { return std::max({v.r, v.g, v.b}); };
  return largest(glm::abs(found - interpolated)) >
         options_.contrast * (largest(glm::max(found, interpolated)) + mean_);
}

bool VertexLight::isCoarse(const EdgeTest& edge) const {
  const auto [a, b] = edge.points;
  const vec3 &from = values_[a], &to = values_[b];
  const int n = intervalsOf(edge.length, kTestEdges * options_.shortestEdge, kMostIntervals);
  for (int i = 1; i < n; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(n);
    SourcePlace place = edge.from;
    place.weights = glm::mix(edge.from.weights, edge.to.weights, t);
    const vec3 found = lightAt(place, hash4(a, b, static_cast<uint32_t>(i), 0));
    // Where an end is inside of another object, the border is somewhere on the edge.
    if (isKnown(from) && isKnown(to)) {
      if (isKnown(found) && isCoarse(found, glm::mix(from, to, t))) return true;
    } else if (isKnown(found) || isKnown(from) || isKnown(to)) {
      return true;
    }
  }
  return false;
}

bool VertexLight::isCoarse(uint32_t part, const DividedMesh::Triangle& triangle,
                           uint32_t number) const {
  std::array<uint32_t, 3> points{};
  for (size_t c = 0; c < 3; ++c) points[c] = mesh_.parts()[part].points[triangle.vertices[c]];
  const auto [a, b, c] = points;
  if (!isKnown(values_[a]) || !isKnown(values_[b]) || !isKnown(values_[c])) return false;
  const Size size = sizeOf(points);
  // The inside of a narrow triangle is near its edges.
  if (size.longest < 2.0f * options_.shortestEdge || size.height < options_.shortestEdge)
    return false;
  const int n =
      std::max(3, intervalsOf(size.longest, kTestEdges * options_.shortestEdge, kMostTriangleRows));
  for (int i = 1; i < n - 1; ++i) {
    for (int j = 1; i + j < n; ++j) {
      const vec3 w = vec3(n - i - j, i, j) / static_cast<float>(n);
      const vec3 weights =
          w.x * triangle.weights[0] + w.y * triangle.weights[1] + w.z * triangle.weights[2];
      const vec3 found =
          lightAt({part, triangle.source, weights},
                  hash4(number, static_cast<uint32_t>(i), static_cast<uint32_t>(j), 1));
      const vec3 interpolated = w.x * values_[a] + w.y * values_[b] + w.z * values_[c];
      if (isKnown(found) && isCoarse(found, interpolated)) return true;
    }
  }
  return false;
}

std::vector<VertexLight::EdgeTest> VertexLight::newEdges() {
  std::vector<EdgeTest> edges;
  for (uint32_t i = 0; i < mesh_.parts().size(); ++i) {
    const DividedMesh::Part& part = mesh_.parts()[i];
    for (const DividedMesh::Triangle& t : part.triangles) {
      if (!t.isNew) continue;
      const Size size = sizeOf(
          {part.points[t.vertices[0]], part.points[t.vertices[1]], part.points[t.vertices[2]]});
      if (size.height < kLeastHeight * size.longest) continue;  // it has no area
      for (size_t e = 0; e < 3; ++e) {
        const size_t from = e, to = (e + 1) % 3;
        const uint32_t a = part.points[t.vertices[from]], b = part.points[t.vertices[to]];
        const float length = lengthOf(a, b);
        if (length < 2.0f * options_.shortestEdge || !tested_.insert(pairOf(a, b)).second) continue;
        edges.push_back(
            {{a, b}, {i, t.source, t.weights[from]}, {i, t.source, t.weights[to]}, length});
      }
    }
  }
  return edges;
}

// Returns whether an edge was divided.
bool VertexLight::divideOnce() {
  const std::vector<EdgeTest> edges = newEdges();
  std::vector<uint8_t> isCoarseEdge(edges.size());
  tbb::parallel_for(size_t{0}, edges.size(),
                    [&](size_t i) { isCoarseEdge[i] = isCoarse(edges[i]); });
  DividedMesh::Edges marked;
  for (size_t i = 0; i < edges.size(); ++i)
    if (isCoarseEdge[i] != 0) marked.insert(mesh_.edgeOf(edges[i].points[0], edges[i].points[1]));
  // Triangles whose edges show nothing.
  for (uint32_t i = 0; i < mesh_.parts().size(); ++i) {
    const DividedMesh::Part& part = mesh_.parts()[i];
    std::vector<std::array<float, 3>> lengths(part.triangles.size());
    std::vector<uint8_t> isCoarseInside(part.triangles.size());
    const auto point = [&](size_t t, size_t c) {
      return part.points[part.triangles[t].vertices[c % 3]];
    };
    tbb::parallel_for(size_t{0}, part.triangles.size(), [&](size_t t) {
      if (!part.triangles[t].isNew) return;
      bool isMarked = false;
      for (size_t e = 0; e < 3; ++e) {
        lengths[t][e] = lengthOf(point(t, e), point(t, e + 1));
        isMarked |= marked.contains(mesh_.edgeOf(point(t, e), point(t, e + 1)));
      }
      isCoarseInside[t] = !isMarked && isCoarse(i, part.triangles[t], static_cast<uint32_t>(t));
    });
    for (size_t t = 0; t < part.triangles.size(); ++t) {
      const float longest = std::ranges::max(lengths[t]);
      for (size_t e = 0; isCoarseInside[t] != 0 && e < 3; ++e)
        if (lengths[t][e] > 0.5f * longest && lengths[t][e] >= 2.0f * options_.shortestEdge)
          marked.insert(mesh_.edgeOf(point(t, e), point(t, e + 1)));
    }
  }
  return mesh_.divide(marked);
}

void VertexLight::refine(const VertexLightOptions& options, float mean) {
  options_ = options;
  mean_ = mean;
  // Edges are at least halved in two rounds.
  float longest = 0.0f;
  for (const DividedMesh::Part& part : mesh_.parts())
    for (const DividedMesh::Triangle& t : part.triangles)
      longest = std::max(longest, sizeOf({part.points[t.vertices[0]], part.points[t.vertices[1]],
                                          part.points[t.vertices[2]]})
                                      .longest);
  int rounds = 2;
  for (; longest > options.shortestEdge; longest *= 0.5f) rounds += 2;
  while (rounds-- > 0 && divideOnce()) findNewLight();
  fillUnknown();
}

// Ring by ring: the mean of known neighbours.
void VertexLight::fillUnknown() {
  for (bool isDone = std::ranges::all_of(values_, isKnown); !isDone;) {
    std::vector<vec4> sums(values_.size(), vec4(0.0f));
    const auto give = [&](uint32_t from, uint32_t to) {
      if (isKnown(values_[from]) && !isKnown(values_[to])) sums[to] += vec4(values_[from], 1.0f);
    };
    for (const DividedMesh::Part& part : mesh_.parts()) {
      for (const DividedMesh::Triangle& t : part.triangles) {
        for (size_t e = 0; e < 3; ++e) {
          const uint32_t a = part.points[t.vertices[e]], b = part.points[t.vertices[(e + 1) % 3]];
          give(a, b);
          give(b, a);
        }
      }
    }
    isDone = true;
    for (size_t i = 0; i < values_.size(); ++i) {
      if (sums[i].w == 0.0f) continue;
      values_[i] = vec3(sums[i]) / sums[i].w;
      isDone = false;
    }
  }
  for (vec3& v : values_)
    if (!isKnown(v)) v = vec3(0.0f);
}

std::shared_ptr<Mesh> VertexLight::litMesh() const {
  auto out = std::make_shared<Mesh>(source_);
  for (size_t i = 0; i < mesh_.parts().size(); ++i) {
    const DividedMesh::Part& part = mesh_.parts()[i];
    Primitive p = mesh_.primitiveOf(i);
    p.colors.resize(p.positions.size(), vec4(1.0f));
    for (size_t v = 0; v < p.colors.size(); ++v)
      p.colors[v] *= vec4(values_[part.points[v]] / kPi, 1.0f);
    out->primitives[node_.parts[i].primitive] = std::move(p);
  }
  return out;
}

}  // namespace lamplighter
