// Which triangles of an object belong together, before where they are: found once for a shape, and
// kept while it only moves and turns, so that a dragged object costs little.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "renderer/patches/bounds_tree.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// All that a topology depends on, beside the object's own vertices. Lengths of the world matrix's
// columns, rounded to a thousandth, so that turning does not change them.
struct ShapeKey {
  vec3 scale{1.0f};
  bool mirrored = false;
  MeshKind kind = MeshKind::automatic;
  bool operator==(const ShapeKey&) const = default;
};
ShapeKey shapeOf(const RenderObject& object);

// Connected triangles in one plane, or nearly in one.
struct ChartTopology {
  uint32_t seed = 0;                // the largest triangle: gives the plane
  bool isRough = false;             // nearly: all triangles give the plane
  std::vector<uint32_t> triangles;  // within the object, ascending
  // Vertices within the object: corners of the border, counter-clockwise as seen from the front,
  // where all of it is one convex polygon; else empty.
  std::vector<uint32_t> outline;
  std::array<uint32_t, 2> longestEdge{};  // vertices within the object
};

// A tree of clusters of triangles that are in no chart.
struct ClusterTopology {
  uint32_t first = 0, count = 0;  // into MeshTopology::loose
  int firstChild = kNone;         // its two children stand one after the other
};

// Loose triangles that stand one after the other and are one occluder: the box around them.
inline constexpr size_t kGroupTriangles = 16;

struct MeshTopology {
  ShapeKey shape;
  std::vector<ChartTopology> charts;
  std::vector<uint32_t> flat;             // triangles in charts, in their order
  std::vector<uint32_t> loose;            // triangles in no chart, neighbours together
  std::vector<ClusterTopology> clusters;  // the first is the root; children after their parents
  BoundsTree occluders;                   // over each of `flat`, then each group of `loose`
};

// The triangles of a rough chart are turned from its plane by no more than this: the sine of 4°.
inline constexpr float kRoughSine = 0.07f;

// Charts are parts of a quarter of a square metre, or a fiftieth of the object's size squared; what
// is smaller or curved is loose. What is flat but for
// a few millimetres and degrees, a square metre of it at least, is rough. Of a
// simple mesh all planar parts are charts, of a complex one none. Deterministic.
MeshTopology findTopology(const RenderScene& scene, uint32_t object);

}  // namespace lamplighter
