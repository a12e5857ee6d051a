// The form factor of an emissive mesh seen from a point, in closed form.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter {

// The sum of the form factors of all triangles that face a point. Edges between two triangles that
// both face it, or both do not, cancel each other: only the outlines of the mesh remain, about 40
// of the 1,920 edges of a sphere.
class MeshFactor {
 public:
  static constexpr size_t kMostTriangles = 2048;

  MeshFactor() = default;
  // corners: three for each of at most kMostTriangles triangles, which face the side from where
  // they run counterclockwise. bothSides: they face both sides.
  MeshFactor(std::span<const vec3> corners, bool bothSides);

  // ∫ cos θ dω over the mesh above the horizon of the unit normal n at x, each triangle on its own
  // [sr]: the irradiance if the mesh has radiance 1 and hides nothing. Triangles in whose plane x
  // lies contribute nothing.
  float at(const vec3& x, const vec3& n) const;

 private:
  // The edge between two vertices, a triangle that has it in this direction, and one that has it in
  // the opposite direction (kNoTriangle: none).
  struct Edge {
    uint32_t from, to;
    uint16_t forwards, backwards;
  };
  static constexpr uint16_t kNoTriangle = kMostTriangles;

  std::vector<vec3> vertices_;
  std::vector<Edge> edges_;
  std::vector<uint32_t> corners_;  // three vertices for each triangle
  // By triangle: a corner, and the normal with the length of twice the area.
  std::vector<float> cornerX_, cornerY_, cornerZ_, normalX_, normalY_, normalZ_, area_;
  Bounds bounds_;
  bool bothSides_ = false;
};

}  // namespace lamplighter
