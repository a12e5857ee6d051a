// A mesh whose triangles are divided at the midpoints of edges. Whether an edge is divided depends
// on the positions of its two ends, so all triangles at it, also those of other primitives, agree:
// no cracks.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include "renderer/bake/node_meshes.h"
#include "renderer/surface_light/own_mesh.h"

namespace lamplighter {

// A point of a triangle of the mesh before it was divided.
struct SourcePlace {
  uint32_t part = 0, triangle = 0;  // of NodeMesh::parts; of its primitive
  vec3 weights{0.0f};               // of the corners
};

class DividedMesh {
 public:
  struct Triangle {
    uint32_t source = 0;                 // triangle of the primitive before
    std::array<uint32_t, 3> vertices{};  // of the part
    std::array<vec3, 3> weights{};       // of the corners in the source triangle
    bool isNew = true;                   // since the last call of divide()
  };
  struct Part {
    Primitive vertices;            // with old indices
    std::vector<uint32_t> points;  // by vertex
    std::vector<Triangle> triangles;
  };
  // Vertices with equal position and normal are one point: they have the same light.
  struct Point {
    vec3 position{0.0f};              // in the space of the node
    uint32_t site = 0;                // points with the same position have the same site
    std::vector<SourcePlace> places;  // in triangles at it; at most kPlaces
  };
  static constexpr size_t kPlaces = 4;

  DividedMesh(const Mesh& mesh, std::span<const NodeMesh::Part> parts);

  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<Point>& points() const { return points_; }

  // An edge by the sites of its ends.
  using Edges = std::unordered_set<uint64_t>;
  uint64_t edgeOf(uint32_t pointA, uint32_t pointB) const;
  // Divides these edges in half. Returns whether there were any.
  bool divide(const Edges& edges);

  // The primitive of a part with its triangles, without changed colours.
  Primitive primitiveOf(size_t part) const;

 private:
  void add(size_t part, uint32_t vertex, const SourcePlace& place);
  uint32_t midpoint(size_t part, uint32_t a, uint32_t b, const SourcePlace& place);

  std::vector<Part> parts_;
  std::vector<Point> points_;
  SampleKeys pointKeys_, siteKeys_;
  std::unordered_map<uint64_t, uint32_t> midpoints_;  // of the current part, by its vertices
};

}  // namespace lamplighter
