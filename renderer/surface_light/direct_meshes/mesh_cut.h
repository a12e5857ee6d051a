// Chooses the nodes of the quad-trees that show the light of a mesh in a view: an edge is divided
// if the light at its middle differs from the mean of its ends (paper 4, section 3).
//
// The decision depends only on the ends and the middle of an edge and on the view. So the triangles
// on both sides agree, and light is continuous: the middle of an undivided edge has the mean of its
// ends, and neither half of it is divided further.
#pragma once

#include <span>
#include <vector>

#include "renderer/scene/camera.h"
#include "renderer/surface_light/direct_meshes/split_tree.h"
#include "renderer/surface_light/direct_meshes/visible_triangles.h"

namespace lamplighter {

// The light of one mesh at the vertices of the trees [W/m²].
struct MeshValues {
  std::vector<vec3> light;
  std::vector<uint8_t> isKnown;

  void resize(size_t vertices) {
    light.resize(vertices, vec3(0.0f));
    isKnown.resize(vertices, 0);
  }
};

// A vertex whose light is missing.
struct VertexRequest {
  uint32_t vertex = 0;
  float priority = 0.0f;  // contrast × visible pixels; kFirst: corners of whole triangles
  static constexpr float kFirst = 1e30f;
};

struct MeshCutOptions {
  float contrast = 0.02f;    // an edge is divided if its middle differs by a larger relative amount
  float leastPixels = 4.0f;  // edges that are shorter in the picture are not divided
  bool operator==(const MeshCutOptions&) const = default;
};

// Edges that are longer than this in the picture are always divided, so that no shadow is missed
// [pixels]
inline constexpr float kLongEdge = 24.0f;

class MeshCut {
 public:
  // `roots`: the nodes of the visible triangles.
  MeshCut(const SplitTree& tree, const MeshValues& values, const VisibleTriangles& visible,
          std::span<const uint32_t> roots, const View& view, const MeshCutOptions& options);

  // Descends from the roots. Returns vertices and nodes that are missing for the final cut, in a
  // fixed order and possibly twice. `light`: if not null, receives the light of each pixel that
  // shows a surface.
  struct Missing {
    std::vector<VertexRequest> vertices;
    std::vector<uint32_t> nodes;  // to be divided
    size_t triangles = 0;         // of the cut
    bool none() const { return vertices.empty() && nodes.empty(); }
  };
  Missing find(std::vector<vec3>* light) const;

 private:
  struct Visit;
  void visit(Visit& at, uint32_t node, const std::array<vec3, 3>& light,
             const std::array<bool, 3>& isFixed, std::span<VisibleTriangles::Pixel> pixels) const;
  float pixelsOf(const vec3& a, const vec3& b) const;
  float contrastOf(const vec3& a, const vec3& b) const;

  const SplitTree& tree_;
  const MeshValues& values_;
  const VisibleTriangles& visible_;
  std::span<const uint32_t> roots_;
  vec3 eye_;
  float focus_;  // pixels per radian
  MeshCutOptions options_;
  bool isRooted_ = true;  // the light of all corners of roots is known
  float floor_ = 0.0f;    // light below this counts as dark
};

}  // namespace lamplighter
