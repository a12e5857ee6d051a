// Where light is kept on the surface of a mesh: a forest of divided triangles with samples at their
// vertices, and clusters of triangles that are too small for that. It depends only on the shape, so
// it is found once and stays while the object moves.
//
// The tree differs from that of the paper, where a triangle has four children or none: it is
// divided only at its long edges. Long thin triangles thus get few elements, and no vertex ever
// lies on an edge that is not divided, so that the light is continuous over edges by construction.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

// A point of one side of the surface. Sides: triangle numbers from the number of triangles on mean
// the backs of the triangles.
struct SurfacePlace {
  uint32_t triangle = 0;
  float u = 0.0f, v = 0.0f;  // weights of the triangle's second and third vertex
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
    std::array<uint32_t, 3> samples{};  // at the corners; of a cluster: all the same
    // Spread evenly over its area. Of a divided triangle: three, each near one corner.
    PlaceRange places;
  };
  struct Node {
    uint32_t first = 0;    // a leaf, or the first of its consecutive children
    uint8_t division = 0;  // triangle_division.h; 0: a leaf
  };
  // The light at a vertex of small triangles, from the clusters near it.
  struct Blend {
    std::array<uint32_t, 4> samples{};
    std::array<float, 4> weights{};  // the sum is 1
  };

  uint32_t triangles = 0, vertices = 0;
  bool hasBacks = false;
  std::vector<SurfacePlace> places;
  std::vector<PlaceRange> samples;  // where irradiance is computed: the mean over its places
  std::vector<Leaf> leaves;
  std::vector<Node> nodes;
  std::vector<Blend> blends;
  // By triangle, then by back: the root of its tree, or −1 − the leaf of its cluster.
  std::vector<int32_t> roots;
  // By vertex, then by vertex seen from the back: the value at it. Values are the samples, then the
  // blends. Only for vertices of triangles in clusters.
  std::vector<uint32_t> valueOfVertex;
  // Samples that share an element with each sample, ascending: those of sample s begin at
  // neighbours[neighbourStarts[s]].
  std::vector<uint32_t> neighbourStarts, neighbours;

  size_t values() const { return samples.size() + blends.size(); }
  size_t bytes() const;
};

struct SurfaceShapeOptions {
  float edge = 0.25f;     // longest edge of an element [m]
  bool hasBacks = false;  // the light on back faces is kept, too
};

// Longest edge of the elements of an object whose longest side is given [m]: it has at most 128
// edges.
float shapeEdge(float longest, float edge);

// The elements of an object's mesh in its own space: rotation and translation change nothing. Edges
// are longer on objects of more than 128 edges.
SurfaceShape findSurfaceShape(const RenderScene& scene, uint32_t object,
                              const SurfaceShapeOptions& options);

// The light at a place. `corners`: the numbers of the triangle's vertices within the object.
MeshPoint pointOf(const SurfaceShape& shape, const SurfacePlace& place,
                  const std::array<uint32_t, 3>& corners);

}  // namespace lamplighter
