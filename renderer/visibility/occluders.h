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

  // The state of the pyramid's light on its patch by all occluders but these objects, and by these
  // alone. The state by all is the greater of both: something is met, or one polygon hides it.
  Occlusion occlusionWithout(const RenderScene& scene, const OcclusionPyramid& pyramid,
                             std::span<const uint32_t> objects) const;
  Occlusion occlusionBy(const RenderScene& scene, const OcclusionPyramid& pyramid,
                        std::span<const uint32_t> objects) const;

 private:
  struct Polygon {
    std::vector<vec3> corners;  // convex
    vec3 normal{0.0f};
  };
  struct Object {
    BoundsTree triangles;
    std::vector<Polygon> polygons;  // large ones, which may hide whole patches
    BoundsTree polygonTree;
  };
  bool meets(const RenderScene& scene, const OcclusionPyramid& pyramid, uint32_t object) const;
  bool hides(const OcclusionPyramid& pyramid, uint32_t object) const;

  std::vector<Object> objects_;
  BoundsTree tree_;  // over the objects' bounds
};

}  // namespace lamplighter
