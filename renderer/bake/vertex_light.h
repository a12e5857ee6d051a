// Light at the vertices of a node's mesh, which is divided where light varies.
#pragma once

#include "renderer/bake/baked_light.h"
#include "renderer/bake/divided_mesh.h"

namespace lamplighter {

struct VertexLightOptions {
  // An edge is divided if the light at a point of it differs by more than this share from linear
  // interpolation between its ends. Relative to the light there plus the mean of the scene.
  float contrast = 0.05f;
  float shortestEdge = 0.1f;  // shortest edge created by division [m]
};

class VertexLight {
 public:
  // Computes the light at the vertices. Keeps references to the arguments.
  VertexLight(const RenderScene& scene, const BakedLight& light, const Mesh& mesh,
              const NodeMesh& node);

  struct Sum {
    double light = 0.0;  // means of the channels
    size_t count = 0;
  };
  Sum sum() const;  // over the vertices whose light is known

  // Divides edges until no contrast is too large, then fills the vertices inside other objects with
  // the light of their neighbours. `mean`: mean irradiance of the scene [W/m²].
  void refine(const VertexLightOptions& options, float mean);

  // The mesh, with colours multiplied by irradiance / π. They may exceed 1.
  std::shared_ptr<Mesh> litMesh() const;

 private:
  struct EdgeTest;
  vec3 lightAt(const SourcePlace& place, uint32_t number) const;
  vec3 lightAt(const DividedMesh::Point& point, uint32_t number) const;
  void findNewLight();
  float lengthOf(uint32_t a, uint32_t b) const;  // world space
  struct Size {
    float longest = 0.0f, height = 0.0f;  // the longest edge, and the height above it
  };
  Size sizeOf(const std::array<uint32_t, 3>& points) const;
  bool isCoarse(const vec3& found, const vec3& interpolated) const;
  bool isCoarse(const EdgeTest& edge) const;
  bool isCoarse(uint32_t part, const DividedMesh::Triangle& triangle, uint32_t number) const;
  std::vector<EdgeTest> newEdges();
  bool divideOnce();
  void fillUnknown();

  const RenderScene& scene_;
  const BakedLight& light_;
  const Mesh& source_;
  const NodeMesh& node_;
  mat3 world_;
  DividedMesh mesh_;
  std::vector<vec3> values_;             // by point; negative: unknown
  std::unordered_set<uint64_t> tested_;  // pairs of points
  VertexLightOptions options_;
  float mean_ = 0.0f;
};

}  // namespace lamplighter
