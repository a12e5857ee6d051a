// Splits the triangles of an object into charts and clusters, independent of their position. The
// result is computed once per shape and kept while the object only moves or rotates, so dragging an
// object is cheap.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "renderer/patches/bounds_tree.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// All inputs of a topology besides the object's own vertices. `scale`: lengths of the columns of
// the world matrix, rounded to a thousandth, so that rotation does not change them.
struct ShapeKey {
  vec3 scale{1.0f};
  bool mirrored = false;
  MeshKind kind = MeshKind::automatic;
  bool operator==(const ShapeKey&) const = default;
};
ShapeKey shapeOf(const RenderObject& object);

// Connected triangles in one plane, or nearly in one plane (rough).
struct ChartTopology {
  uint32_t seed = 0;                // the largest triangle; it defines the plane
  bool isRough = false;             // nearly planar: all triangles together define the plane
  std::vector<uint32_t> triangles;  // indices within the object, ascending
  // Border vertices (indices within the object), counter-clockwise seen from the front, if the
  // chart is one convex polygon; otherwise empty.
  std::vector<uint32_t> outline;
  std::array<uint32_t, 2> longestEdge{};  // vertex indices within the object
};

// Node of a tree of clusters. Clusters hold triangles that are in no chart.
struct ClusterTopology {
  uint32_t first = 0, count = 0;  // into MeshTopology::loose
  int firstChild = kNone;         // the two children are consecutive
};

// Number of consecutive loose triangles that form one occluder, their bounding box.
inline constexpr size_t kGroupTriangles = 16;

struct MeshTopology {
  ShapeKey shape;
  std::vector<ChartTopology> charts;
  std::vector<uint32_t> flat;             // triangles in charts, ordered by chart
  std::vector<uint32_t> loose;            // triangles in no chart, ordered so that neighbours are
                                          // close
  std::vector<ClusterTopology> clusters;  // the first is the root; children follow their parents
  BoundsTree occluders;                   // over each triangle of `flat`, then each group of
                                          // `loose`
};

// Sine of 4°, the largest angle between a triangle and the plane of its rough chart.
inline constexpr float kRoughSine = 0.07f;

// Lengths [m] and areas [m²] that divide charts from loose triangles.
struct TopologyLimits {
  float large = 0.25f;           // smallest area of a chart
  float rough = 0.0025f;         // largest height of bumps, on both sides of the plane
  float largeRough = 1.0f;       // smallest area of a rough chart: no bent surface has so large a
                                 // part near a plane
  float smallestCluster = 2.0f;  // smaller clusters are not halved
  bool operator==(const TopologyLimits&) const = default;
};

// Deterministic. A planar part becomes a chart if it is large, or at least a fiftieth of the
// object's size squared. Smaller or curved parts are loose. A large part that is planar within a
// few millimetres and degrees becomes a rough chart. In a simple mesh all planar parts are charts;
// in a complex mesh there are none.
MeshTopology findTopology(const RenderScene& scene, uint32_t object,
                          const TopologyLimits& limits = {});

}  // namespace lamplighter
