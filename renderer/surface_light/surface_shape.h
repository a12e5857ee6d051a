// The places where light is stored on the surface of a mesh: a forest of divided triangles with
// samples at their vertices, and clusters of triangles that are too small for that. It depends only
// on the shape, so it is computed once and does not change while the object moves.
//
// The tree differs from that of the paper, where a triangle has four children or none: it is
// divided only at its long edges. Long thin triangles thus get few elements, and no vertex lies on
// an undivided edge, so that the light is continuous across edges by construction.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

// A point of one side of the surface. Triangle numbers that are not less than the number of
// triangles mean back faces.
struct SurfacePlace {
  uint32_t triangle = 0;
  float u = 0.0f, v = 0.0f;  // weights of the second and third vertex of the triangle
};

// A range of SurfaceShape::places.
struct PlaceRange {
  uint32_t first = 0, count = 0;
};

// The light of a point: a weighted sum of three values, and the element on which it lies.
struct MeshPoint {
  uint32_t leaf = 0;
  std::array<uint32_t, 3> values{};
  vec3 weights{1.0f, 0.0f, 0.0f};
};

struct SurfaceShape {
  // An element that reflects light.
  struct Leaf {
    std::array<uint32_t, 3> samples{};  // at the corners; for a cluster: all equal
    // Points spread evenly over its area. For a divided triangle: three, each near one corner.
    PlaceRange places;
  };
  struct Node {
    uint32_t first = 0;    // a leaf, or the first of its consecutive children
    uint8_t division = 0;  // triangle_division.h; 0: a leaf
  };
  // The light at a vertex of small triangles: weighted sum of nearby clusters.
  struct Blend {
    std::array<uint32_t, 4> samples{};
    std::array<float, 4> weights{};  // the sum is 1
  };

  uint32_t triangles = 0, vertices = 0;
  bool hasBacks = false;
  std::vector<SurfacePlace> places;
  std::vector<PlaceRange> samples;  // each is the mean irradiance over its places
  std::vector<Leaf> leaves;
  std::vector<Node> nodes;
  std::vector<Blend> blends;
  // By triangle (front faces, then back faces): the root of its tree, or −1 − the leaf of its
  // cluster.
  std::vector<int32_t> roots;
  // By vertex (front side, then back side): its value. Values are the samples, then the blends.
  // Only for vertices of triangles in clusters.
  std::vector<uint32_t> valueOfVertex;
  // Samples that share an element with each sample, ascending: those of sample s begin at
  // neighbours[neighbourStarts[s]].
  std::vector<uint32_t> neighbourStarts, neighbours;

  size_t values() const { return samples.size() + blends.size(); }
  size_t bytes() const;
};

struct SurfaceShapeOptions {
  float edge = 0.25f;     // longest edge of an element [m]
  bool hasBacks = false;  // light is also stored on back faces
};

// Longest edge of the elements of an object whose longest side is given [m]: it has at most 128
// edges.
float shapeEdge(float longest, float edge);

// Computes the elements of the mesh of an object in object space: independent of rotation and
// translation. Edges are longer on objects that would have more than 128 edges along their longest
// side.
SurfaceShape findSurfaceShape(const RenderScene& scene, uint32_t object,
                              const SurfaceShapeOptions& options);

// The values for the light at a point. `corners`: the vertices of the triangle, as indices within
// the object.
MeshPoint pointOf(const SurfaceShape& shape, const SurfacePlace& place,
                  const std::array<uint32_t, 3>& corners);

}  // namespace lamplighter
