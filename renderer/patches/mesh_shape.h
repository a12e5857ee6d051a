// The triangles of an object in object space, with their neighbours: the input of findTopology().
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

// The object's own vertices, scaled but not rotated or moved [m]. In a mirrored object the
// triangles show their back faces here.
class MeshShape {
 public:
  // scale: by axis of the object.
  MeshShape(const RenderScene& scene, const RenderObject& object, const vec3& scale);

  uint32_t triangles() const { return count_; }
  const Bounds& bounds() const { return bounds_; }
  uint32_t vertex(uint32_t t, size_t corner) const { return corners_[size_t{3} * t + corner]; }
  const vec3& at(uint32_t t, size_t corner) const { return positions_[vertex(t, corner)]; }
  const vec3& position(uint32_t vertex) const { return positions_[vertex]; }
  Bounds boundsOf(uint32_t t) const;

  // Finds areas, normals and neighbours, which the functions below return. Vertices with equal
  // positions are welded, because meshes are split where normals or textures are discontinuous.
  // Triangles that cannot be connected, because three meet at an edge, stay separate.
  void connect();
  float area(uint32_t t) const { return areas_[t]; }
  const vec3& normal(uint32_t t) const { return normals_[t]; }  // zero: the triangle has no area
  // The triangle across each edge; kNone at a border.
  const std::array<int, 3>& neighbours(uint32_t t) const { return neighbours_[t]; }
  // An edge: its two welded vertices, and a vertex of the triangle at each.
  struct Side {
    int from, to;
    uint32_t fromVertex, toVertex;
  };
  std::array<Side, 3> sides(uint32_t t) const;

 private:
  void measure();
  void weld();

  uint32_t count_;
  std::vector<vec3> positions_;
  std::vector<uint32_t> corners_;
  std::vector<int> welded_;        // by vertex: the number of its position
  std::vector<uint32_t> firstOf_;  // by number of a position: the first vertex there
  std::vector<vec3> normals_;
  std::vector<float> areas_;
  std::vector<std::array<int, 3>> neighbours_;
  Bounds bounds_;
};

}  // namespace lamplighter
