// What can stand between lights and patches: all surfaces but clear ones.
#pragma once

#include <vector>

#include "renderer/visibility/bounds_tree.h"
#include "renderer/visibility/occlusion_pyramid.h"

namespace lamplighter {

class Occluders {
 public:
  // Everything anew.
  void build(const RenderScene& scene, const std::vector<ObjectPatches>& patches);
  // Of one object that moved; call finish() after the last.
  void rebuild(const RenderScene& scene, uint32_t object, const ObjectPatches& patches);
  void finish(const RenderScene& scene);

  // The state of the pyramid's light on its patch. Counts one test.
  Occlusion occlusionOf(const RenderScene& scene, const OcclusionPyramid& pyramid) const;

 private:
  struct Polygon {
    std::vector<vec3> corners;  // convex
    vec3 normal{0.0f};
  };
  struct Object {
    BoundsTree triangles;
    std::vector<Polygon> polygons;  // may hide whole patches
    std::vector<int> polygonOf;     // a triangle's, or kNone
  };
  std::vector<Object> objects_;
  BoundsTree tree_;  // over the objects' bounds
};

}  // namespace lamplighter
