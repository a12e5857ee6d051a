// Charts: the planar parts of a level, whatever its meshes are (paper 1 has rectangles only). What
// lies in no plane with its neighbours is left to clusters (patch_set.h).
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/patches/topology.h"

namespace lamplighter {

// Connected triangles of one object in one plane, or nearly.
struct Chart {
  uint32_t object = 0;              // index into RenderScene::objects
  vec3 origin{0.0f};                // on the plane, world space
  vec3 tangent, bitangent, normal;  // unit, right-handed; the normal is the triangles' front
  vec2 min{0.0f}, max{0.0f};        // what they cover, along tangent and bitangent from the origin
  float thickness = 0.0f;           // all of it is within this of the plane [m]
  float area = 0.0f;                // m²
  std::vector<uint32_t> triangles;  // within the object, ascending
  // It has bumps that are more than rounding, and they cast no shadow on it.
  bool isRough = false;
  // The border, counter-clockwise as seen from the front, where all of it is one convex polygon;
  // else empty. World space.
  std::vector<vec3> outline;

  vec3 at(const vec2& p) const { return origin + p.x * tangent + p.y * bitangent; }
  vec2 project(const vec3& p) const {
    return {glm::dot(p - origin, tangent), glm::dot(p - origin, bitangent)};
  }
};

// The charts of an object where it is now.
std::vector<Chart> placeCharts(const RenderScene& scene, uint32_t object,
                               const MeshTopology& topology);

}  // namespace lamplighter
