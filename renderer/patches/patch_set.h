// Patches: the pieces of surface for which the visibility database stores, per light, whether
// anything can block it (paper 1, 4.3.1). Rectangles on charts, and boxes around clusters of
// triangles that are in no chart. Each chart and cluster is the root of a binary tree.
#pragma once

#include <vector>

#include "renderer/base/revision.h"
#include "renderer/patches/charts.h"

namespace lamplighter {

struct Patch {
  int chart = kNone;          // index of the object's chart; kNone: a cluster of triangles with a
                              // box
  vec2 min{0.0f}, max{0.0f};  // chart: rectangle in the frame of the chart
  Bounds box;                 // cluster: world space
  vec3 centre{0.0f};          // centre of a bounding sphere; the sphere also contains those of the
                              // children
  float radius = 0.0f;        // of the bounding sphere [m]
  int parent = kNone;
  int firstChild = kNone;  // the two children are consecutive
  int axis = 0;            // chart: split at the middle; 0: across tangent, 1: across bitangent
  bool isLeaf() const { return firstChild == kNone; }
};

// The charts and patches of one object. They depend only on its triangles, not on earlier
// positions.
struct ObjectPatches {
  Revision revision;    // changes whenever the patches are placed
  Bounds bounds;        // of the object
  float radius = 0.0f;  // of a sphere around the centre of the bounds that contains the object [m]
  std::vector<Chart> charts;
  std::vector<Patch> patches;        // children follow their parents
  std::vector<int> roots;            // indices into patches
  std::vector<size_t> countAtLevel;  // number of patches per tree level; level 0 are the roots
  std::vector<Bounds> groups;        // boxes around kGroupTriangles of MeshTopology::loose each
  BoundsTree tree;                   // over the boxes of the roots' bounding spheres, in the order
                                     // of `roots`
  std::vector<int> patchOfTriangle;  // by triangle: the root of its chart, or the leaf of its
                                     // cluster

  // The leaf that contains a point of one of the object's triangles.
  int leafAt(uint32_t triangle, const vec3& position) const;
};

// A rectangle is halved at most seven times, and only if both halves are at least 0.6 m long.
ObjectPatches placePatches(const RenderScene& scene, uint32_t object, const MeshTopology& topology);

}  // namespace lamplighter
