#include "renderer/surface_light/surface_shape.h"

#include <algorithm>
#include <span>
#include <utility>

#include "renderer/patches/topology.h"
#include "renderer/surface_light/own_mesh.h"
#include "renderer/surface_light/shape_clusters.h"
#include "renderer/surface_light/triangle_division.h"

namespace lamplighter {
namespace {

// Triangles smaller than this share of a squared edge are in clusters.
constexpr float kSmallShare = 0.125f;
// Largest number of edges along the longest side of an object.
constexpr float kMostEdges = 128.0f;
// Samples are moved from the corners of an element towards its middle by this share, so that their
// rays do not start inside a wall that stands there, and so that the light very near a wall, which
// changes fast, is not used for the whole element.
constexpr float kInwards = 0.1f;

class TreeBuilder {
 public:
  TreeBuilder(const OwnMesh& mesh, float edge, SampleKeys& keys, SurfaceShape& out)
      : mesh_(mesh), edge_(edge), keys_(keys), out_(out) {}

  void addRoot(uint32_t triangle, bool isBack) {
    triangle_ = triangle + (isBack ? mesh_.triangles() : 0);
    std::array<Corner, 3> corners;
    for (uint32_t c = 0; c < 3; ++c) {
      const OwnMesh::Vertex v = mesh_.vertex(triangle, c, isBack);
      corners[c] = {v.position, v.normal, vec3(c == 0, c == 1, c == 2)};
    }
    out_.roots[triangle_] = static_cast<int32_t>(out_.nodes.size());
    out_.nodes.emplace_back();
    divide(out_.nodes.size() - 1, corners);
  }

 private:
  struct Corner {
    vec3 position, normal;
    vec3 weights;  // in the root
  };

  void divide(size_t node, const std::array<Corner, 3>& c) {
    int edges = 0;
    for (size_t e = 0; e < 3; ++e)
      if (glm::distance(c[kEdgeCorners[e][0]].position, c[kEdgeCorners[e][1]].position) > edge_)
        edges |= 1 << e;
    if (edges == 0) return addLeaf(node, c);
    std::array<Corner, 6> points{c[0], c[1], c[2]};
    for (size_t e = 0; e < 3; ++e)
      points[3 + e] = between(c[kEdgeCorners[e][0]], c[kEdgeCorners[e][1]]);
    const int division = divisionOf(edges, takesOtherDiagonal(edges, points));
    const TriangleDivision& d = triangleDivision(division);
    const size_t first = out_.nodes.size();
    out_.nodes[node] = {static_cast<uint32_t>(first), static_cast<uint8_t>(division)};
    out_.nodes.resize(first + static_cast<size_t>(d.count));
    for (size_t i = 0; i < static_cast<size_t>(d.count); ++i)
      divide(first + i,
             {points[d.children[i][0]], points[d.children[i][1]], points[d.children[i][2]]});
  }

  static Corner between(const Corner& a, const Corner& b) {
    const vec3 normal = a.normal + b.normal;
    const float length = glm::length(normal);
    return {0.5f * (a.position + b.position), length > 0.0f ? normal / length : a.normal,
            0.5f * (a.weights + b.weights)};
  }

  // Whether the second diagonal of the quadrilateral beside a cut corner is the shorter one.
  static bool takesOtherDiagonal(int edges, const std::array<Corner, 6>& p) {
    const auto length = [&](int a, int b) {
      return glm::distance(p[static_cast<size_t>(a)].position, p[static_cast<size_t>(b)].position);
    };
    if (edges == 3) return length(3, 2) < length(0, 4);
    if (edges == 6) return length(1, 5) < length(0, 4);
    if (edges == 5) return length(1, 5) < length(3, 2);
    return false;
  }

  void addLeaf(size_t node, const std::array<Corner, 3>& c) {
    SurfaceShape::Leaf leaf;
    const vec3 middle = (c[0].weights + c[1].weights + c[2].weights) / 3.0f;
    for (size_t k = 0; k < 3; ++k) {
      const auto [id, isNew] = keys_.find(c[k].position, c[k].normal);
      if (isNew) {
        out_.samples.push_back({static_cast<uint32_t>(out_.places.size()), 1});
        addPlace(glm::mix(c[k].weights, middle, kInwards));
      }
      leaf.samples[k] = id;
    }
    leaf.places = {static_cast<uint32_t>(out_.places.size()), 3};
    for (const Corner& corner : c) addPlace(glm::mix(middle, corner.weights, 0.5f));
    out_.nodes[node] = {static_cast<uint32_t>(out_.leaves.size()), 0};
    out_.leaves.push_back(leaf);
  }

  void addPlace(const vec3& weights) { out_.places.push_back({triangle_, weights.y, weights.z}); }

  const OwnMesh& mesh_;
  float edge_;
  SampleKeys& keys_;
  SurfaceShape& out_;
  uint32_t triangle_ = 0;
};

// By sample: the samples that share an element with it, in order.
void findNeighbours(SurfaceShape& shape) {
  const size_t samples = shape.samples.size();
  std::vector<uint32_t> ends(samples + 1, 0);  // of the lists, with repetitions
  for (const SurfaceShape::Leaf& leaf : shape.leaves)
    for (const uint32_t a : leaf.samples) ends[a + 1] += 2;
  for (size_t i = 1; i <= samples; ++i) ends[i] += ends[i - 1];
  std::vector<uint32_t> all(ends.back()), next(ends.begin(), ends.end() - 1);
  for (const SurfaceShape::Leaf& leaf : shape.leaves)
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = leaf.samples[k];
      all[next[a]++] = leaf.samples[(k + 1) % 3];
      all[next[a]++] = leaf.samples[(k + 2) % 3];
    }
  shape.neighbourStarts.assign(1, 0);
  for (uint32_t s = 0; s < samples; ++s) {
    const auto list = std::span(all).subspan(ends[s], ends[s + 1] - ends[s]);
    std::ranges::sort(list);
    for (size_t k = 0; k < list.size(); ++k)
      if (list[k] != s && (k == 0 || list[k] != list[k - 1])) shape.neighbours.push_back(list[k]);
    shape.neighbourStarts.push_back(static_cast<uint32_t>(shape.neighbours.size()));
  }
}

}  // namespace

size_t SurfaceShape::bytes() const {
  return places.size() * sizeof(SurfacePlace) + samples.size() * sizeof(PlaceRange) +
         leaves.size() * sizeof(Leaf) + nodes.size() * sizeof(Node) +
         blends.size() * sizeof(Blend) + roots.size() * sizeof(int32_t) +
         (valueOfVertex.size() + neighbourStarts.size() + neighbours.size()) * sizeof(uint32_t);
}

float shapeEdge(float longest, float edge) { return std::max(edge, longest / kMostEdges); }

SurfaceShape findSurfaceShape(const RenderScene& scene, uint32_t object,
                              const SurfaceShapeOptions& options) {
  const OwnMesh mesh(scene, object);
  SurfaceShape out;
  out.triangles = mesh.triangles();
  out.vertices = mesh.vertices();
  out.hasBacks = options.hasBacks;
  const uint32_t sides = options.hasBacks ? 2 : 1;
  out.roots.resize(sides * out.triangles);
  const vec3 size = mesh.bounds().extent();
  const float edge = shapeEdge(std::max({size.x, size.y, size.z}), options.edge);
  SampleKeys keys;
  TreeBuilder trees(mesh, edge, keys, out);
  std::vector<uint32_t> small;
  for (uint32_t side = 0; side < sides; ++side) {
    for (uint32_t t = 0; t < out.triangles; ++t) {
      if (mesh.area(t) >= kSmallShare * edge * edge)
        trees.addRoot(t, side == 1);
      else if (side == 0)
        small.push_back(t);
    }
  }
  if (!small.empty()) addClusters(mesh, small, edge, keys, out);
  findNeighbours(out);
  return out;
}

MeshPoint pointOf(const SurfaceShape& shape, const SurfacePlace& place,
                  const std::array<uint32_t, 3>& corners) {
  MeshPoint out;
  out.weights = vec3(1.0f - place.u - place.v, place.u, place.v);
  const int32_t root = shape.roots[place.triangle];
  if (root < 0) {
    out.leaf = static_cast<uint32_t>(-1 - root);
    const uint32_t side = place.triangle >= shape.triangles ? shape.vertices : 0;
    for (size_t c = 0; c < 3; ++c) out.values[c] = shape.valueOfVertex[side + corners[c]];
    return out;
  }
  const SurfaceShape::Node* node = &shape.nodes[static_cast<size_t>(root)];
  while (node->division != 0) {
    const int child = childAt(node->division, out.weights);
    node = &shape.nodes[node->first + static_cast<uint32_t>(child)];
  }
  out.leaf = node->first;
  out.values = shape.leaves[out.leaf].samples;
  return out;
}

}  // namespace lamplighter
