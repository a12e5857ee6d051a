// What can stand between lights and patches: all surfaces but clear ones. Planar parts are tested
// triangle by triangle, complex ones by boxes around a few triangles each (paper 1 takes a sphere
// around a whole complex object).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/visibility/occlusion/light_packet.h"
#include "renderer/visibility/occlusion/occlusion_pyramid.h"

namespace lamplighter {

class FullOccluderX8;

// What a pyramid met: an item of an object. Most of what meets a pyramid meets the next one too,
// that of a child or of a light nearby, so that there it is asked first.
struct Blocker {
  int object = kNone;
  uint32_t item = 0;
  // A point of it where it was met, if that is known: a pyramid that holds it meets the item.
  bool hasPoint = false;
  vec3 at{0.0f};
};

class Occluders {
 public:
  // Up to eight lights that are not parallel, for which a rectangle is neither dark nor degenerate.
  struct Lights {
    std::span<const shared::Vpl* const> vpls;
    const PatchRegion& region;
  };
  using States = std::array<Occlusion, LightPacket::kLights>;

  void resize(size_t objects) { objects_.resize(objects); }
  // One object where it is now; call finish() after the last.
  void place(const RenderScene& scene, uint32_t object, const MeshTopology& topology,
             const ObjectPatches& patches);
  void finish(const RenderScene& scene);

  // The state of the pyramid's light on its patch by all occluders but these objects, and by these
  // alone. The state by all is the greater of both: something is met, or one polygon hides it.
  // `first` is asked first, and becomes what was met; it changes no answer.
  Occlusion occlusionWithout(const RenderScene& scene, const OcclusionPyramid& pyramid,
                             std::span<const uint32_t> objects, Blocker& first) const;
  Occlusion occlusionBy(const RenderScene& scene, const OcclusionPyramid& pyramid,
                        std::span<const uint32_t> objects, Blocker& first) const;
  // The first of both, of several lights; `first` by light.
  States occlusionsWithout(const RenderScene& scene, const Lights& lights,
                           std::span<const uint32_t> objects, std::span<Blocker> first) const;
  // Boxes around some of its triangles each, and whether they are all there is of it.
  std::span<const Bounds> groups(uint32_t object) const { return objects_[object].groups; }
  bool isOfGroups(uint32_t object) const {
    return objects_[object].flat.empty() && !objects_[object].groups.empty();
  }
  // Whether one polygon of other objects hides all of the pyramid's patch.
  bool hiddenWithout(const OcclusionPyramid& pyramid, std::span<const uint32_t> objects) const;
  // Whether one polygon stands between an eye, the pyramid's light, and all of its patch, so that
  // it is drawn over it: its front does, where its back is not drawn.
  bool hiddenFromEye(const RenderScene& scene, const OcclusionPyramid& pyramid,
                     const vec3& eye) const;
  // Whether one of the object's polygons is large enough to hide patches.
  bool mayHide(uint32_t object) const { return !objects_[object].polygons.empty(); }
  const Caster& caster(uint32_t object) const { return objects_[object].caster; }

 private:
  struct Object {
    Caster caster;
    std::vector<uint32_t> flat;             // triangles that are tested themselves
    std::vector<int> roughChart;            // of each of them; empty: none is in one
    BoundsTree tree;                        // over those, then groups
    std::vector<Bounds> groups;             // of loose triangles
    std::vector<OccluderPolygon> polygons;  // large ones, which may hide whole patches
    BoundsTree polygonTree;
  };
  class Search;
  LightPacket::Mask hiddenWithout(const FullOccluderX8& batch, LightPacket::Mask of,
                                  std::span<const uint32_t> objects) const;
  bool meets(const RenderScene& scene, const OcclusionPyramid& pyramid, uint32_t object,
             uint32_t item, vec3& at) const;
  bool meets(const RenderScene& scene, const OcclusionPyramid& pyramid, uint32_t object,
             Blocker& met) const;
  // A rough chart's bumps do not stand in its own light.
  bool isItself(const OcclusionPyramid& pyramid, uint32_t object, uint32_t item) const;
  bool stillMeets(const RenderScene& scene, const OcclusionPyramid& pyramid,
                  Blocker& blocker) const;
  bool hides(const OcclusionPyramid& pyramid, const OcclusionPyramid::Axis& axis,
             uint32_t object) const;

  std::vector<Object> objects_;
  BoundsTree tree_;         // over the objects' bounds
  BoundsTree polygonTree_;  // over those of their large polygons
};

}  // namespace lamplighter
