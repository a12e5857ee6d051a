// Patches: the pieces of surface for which it is known, light by light, whether anything can stand
// between (paper 1, 4.3.1). Rectangles of charts, and boxes around what is in no chart; each a
// tree.
#pragma once

#include <vector>

#include "renderer/base/revision.h"
#include "renderer/patches/charts.h"

namespace lamplighter {

struct Patch {
  int chart = kNone;          // of the object's charts; kNone: a cluster of triangles, with a box
  vec2 min{0.0f}, max{0.0f};  // chart: its rectangle, in the chart's frame
  Bounds box;                 // cluster: world space
  vec3 centre{0.0f};          // of a sphere around it, and around those of its children
  float radius = 0.0f;        // of that sphere [m]
  int parent = kNone;
  int firstChild = kNone;  // its two children stand one after the other
  int axis = 0;            // chart: 0: split across tangent, 1: across bitangent, in the middle
  bool isLeaf() const { return firstChild == kNone; }
};

// The charts and patches of one object. Made from its triangles alone, so that they do not tell
// where it was before.
struct ObjectPatches {
  Revision revision;    // another each time they are placed
  Bounds bounds;        // of the object
  float radius = 0.0f;  // of a sphere around the middle of the bounds that holds all of it [m]
  std::vector<Chart> charts;
  std::vector<Patch> patches;        // children after their parents
  std::vector<int> roots;            // into patches
  std::vector<size_t> countAtLevel;  // patches whose root was divided so many times for them
  std::vector<Bounds> groups;        // around kGroupTriangles of MeshTopology::loose each
  BoundsTree tree;                   // over boxes around the roots' spheres, in their order
  std::vector<int> patchOfTriangle;  // the root of its chart, or the leaf of its cluster

  // The leaf that a point of a triangle of the object lies in.
  int leafAt(uint32_t triangle, const vec3& position) const;
};

// Rectangles are halved seven times at most, and only where both halves are at least 0.6 m long.
ObjectPatches placePatches(const RenderScene& scene, uint32_t object, const MeshTopology& topology);

}  // namespace lamplighter
