// Charts: the planar parts of arbitrary meshes (paper 1 has only rectangles). Triangles that are
// not coplanar with their neighbours go to clusters (patch_set.h).
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/patches/topology.h"

namespace lamplighter {

// Connected triangles of one object in one plane, or nearly in one plane.
struct Chart {
  uint32_t object = 0;              // index into RenderScene::objects
  vec3 origin{0.0f};                // on the plane, world space
  vec3 tangent, bitangent, normal;  // unit, right-handed; the normal is on the front side of the
                                    // triangles
  vec2 min{0.0f}, max{0.0f};        // bounds along tangent and bitangent, relative to the origin
  float thickness = 0.0f;           // largest distance of the surface from the plane [m]
  float area = 0.0f;                // m²
  std::vector<uint32_t> triangles;  // indices within the object, ascending
  // Its bumps are larger than rounding errors; they do not cast shadows on the chart itself.
  bool isRough = false;
  // World space. The border, counter-clockwise seen from the front, if the chart is one convex
  // polygon; otherwise empty.
  std::vector<vec3> outline;

  vec3 at(const vec2& p) const { return origin + p.x * tangent + p.y * bitangent; }
  vec2 project(const vec3& p) const {
    return {glm::dot(p - origin, tangent), glm::dot(p - origin, bitangent)};
  }
};

// The charts of an object at its present position.
std::vector<Chart> placeCharts(const RenderScene& scene, uint32_t object,
                               const MeshTopology& topology);

}  // namespace lamplighter
