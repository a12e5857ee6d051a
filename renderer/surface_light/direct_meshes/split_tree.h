// Quad-trees over the triangles of a scene: a node is divided into four at the midpoints of its
// edges (paper 4, section 3). The trees contain all vertices and divisions that any light has
// requested; each light shows a cut of them (mesh_cut.h).
#pragma once

#include <array>
#include <span>
#include <unordered_map>
#include <vector>

#include "renderer/scene/render_scene.h"
#include "renderer/surface_light/direct_meshes/visible_triangles.h"

namespace lamplighter {

class SplitTree {
 public:
  static constexpr uint32_t kNone = 0xffffffffu;

  // Vertices with equal position and normal are shared between triangles. World space.
  struct Vertex {
    vec3 position{0.0f}, normal{0.0f};  // unit length, on the lit side
    uint32_t leftOutBy = 0;             // light_linking.h
    bool operator==(const Vertex&) const = default;
  };
  // Edge k lies between corners k and k + 1, middle k halfway on it. Child k < 3 has corner k;
  // child 3 has the middles 1, 2 and 0 as its corners.
  struct Node {
    std::array<uint32_t, 3> corners{}, middles{kNone, kNone, kNone};
    uint32_t children = kNone;  // the first of four
  };

  // The node of a whole triangle; creates it if necessary.
  uint32_t root(const RenderScene& scene, const VisibleTriangles::Triangle& triangle);
  // Discards the trees of objects whose triangles moved.
  void forgetRoots(std::span<const uint32_t> objects);
  // Divides a node that has no children.
  void split(uint32_t node);

  const Node& node(uint32_t number) const { return nodes_[number]; }
  const Vertex& vertex(uint32_t number) const { return vertices_[number]; }
  size_t vertices() const { return vertices_.size(); }
  size_t bytes() const;

 private:
  struct Hash {
    size_t operator()(const Vertex& v) const;
  };
  uint32_t number(const Vertex& vertex);
  uint32_t middle(uint32_t a, uint32_t b);

  std::vector<Vertex> vertices_;
  std::vector<Node> nodes_;
  std::unordered_map<Vertex, uint32_t, Hash> numbers_;
  std::unordered_map<uint64_t, uint32_t> roots_;
};

}  // namespace lamplighter
