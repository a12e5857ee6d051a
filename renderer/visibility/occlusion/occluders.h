// The occluders: all surfaces except clear ones. Planar parts are tested triangle by triangle,
// complex parts by boxes around a few triangles each (paper 1 uses one sphere around a complex
// object).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/visibility/occlusion/light_packet.h"
#include "renderer/visibility/occlusion/occlusion_pyramid.h"

namespace lamplighter {

template <typename Tag>
class FullOccluder;

// The item of an object that a pyramid met. It probably meets the next pyramid too (of a child
// patch or of a light nearby), so that pyramid tests it first.
struct Blocker {
  int object = kNone;
  uint32_t item = 0;
  // `at` is a point of the item inside the pyramid. A pyramid that contains this point meets the
  // item.
  bool hasPoint = false;
  vec3 at{0.0f};
};

class Occluders {
 public:
  // Up to eight non-parallel lights for which the rectangle is neither dark nor degenerate.
  struct Lights {
    std::span<const shared::Vpl* const> vpls;
    const PatchRegion& region;
  };
  using States = std::array<Occlusion, LightPacket::kLights>;

  void resize(size_t objects) { objects_.resize(objects); }
  // Places one object at its present position; call finish() after the last.
  void place(const RenderScene& scene, uint32_t object, const MeshTopology& topology,
             const ObjectPatches& patches);
  void finish(const RenderScene& scene);

  // The state of the pyramid's light on its patch due to all occluders except these objects, and
  // due to these objects only. The state due to all occluders is the larger of both. `first` is
  // tested first and is set to the blocker that was met; it does not change the result.
  Occlusion occlusionWithout(const RenderScene& scene, const OcclusionPyramid& pyramid,
                             std::span<const uint32_t> objects, Blocker& first) const;
  Occlusion occlusionBy(const RenderScene& scene, const OcclusionPyramid& pyramid,
                        std::span<const uint32_t> objects, Blocker& first) const;
  // occlusionWithout() for several lights; `first` by light.
  States occlusionsWithout(const RenderScene& scene, const Lights& lights,
                           std::span<const uint32_t> objects, std::span<Blocker> first) const;
  // Boxes around groups of the object's loose triangles. isOfGroups(): the object has no other
  // parts.
  std::span<const Bounds> groups(uint32_t object) const { return objects_[object].groups; }
  bool isOfGroups(uint32_t object) const {
    return objects_[object].flat.empty() && !objects_[object].groups.empty();
  }
  // Whether one polygon of another object hides the whole patch of the pyramid.
  bool hiddenWithout(const OcclusionPyramid& pyramid, std::span<const uint32_t> objects) const;
  // Whether one polygon lies between the eye (the light of the pyramid) and the whole patch, and is
  // drawn in front of it: its front side faces the eye if its back is not drawn.
  bool hiddenFromEye(const RenderScene& scene, const OcclusionPyramid& pyramid,
                     const vec3& eye) const;
  // Whether a polygon of the object is large enough to hide patches.
  bool mayHide(uint32_t object) const { return !objects_[object].polygons.empty(); }
  const Caster& caster(uint32_t object) const { return objects_[object].caster; }

 private:
  struct Object {
    Caster caster;
    std::vector<uint32_t> flat;             // triangles that are tested individually
    std::vector<int> roughChart;            // by index in `flat`; empty: no triangle is in a rough
                                            // chart
    BoundsTree tree;                        // over `flat`, then groups
    std::vector<Bounds> groups;             // of loose triangles
    std::vector<OccluderPolygon> polygons;  // large polygons, which may hide whole patches
    BoundsTree polygonTree;
  };
  class Search;
  // Those of the lights `of` for which one polygon of the object, or of another object than these,
  // hides the whole patch (full_occluders.cpp).
  template <typename Tag>
  LightMask hiddenBy(const FullOccluder<Tag>& test, LightMask of, uint32_t object) const;
  template <typename Tag>
  LightMask hiddenWithout(const FullOccluder<Tag>& test, LightMask of,
                          std::span<const uint32_t> objects) const;
  LightMask hiddenWithout(const LightPacket& lights, const PatchRegion& region, LightMask of,
                          std::span<const uint32_t> objects) const;
  bool isHiddenBy(const OcclusionPyramid& pyramid, uint32_t object) const;
  bool meets(const RenderScene& scene, const OcclusionPyramid& pyramid, uint32_t object,
             uint32_t item, vec3& at) const;
  bool meets(const RenderScene& scene, const OcclusionPyramid& pyramid, uint32_t object,
             Blocker& met) const;
  // Whether the item belongs to the patch's own rough chart, whose bumps do not shadow the chart.
  bool isItself(const OcclusionPyramid& pyramid, uint32_t object, uint32_t item) const;
  bool stillMeets(const RenderScene& scene, const OcclusionPyramid& pyramid,
                  Blocker& blocker) const;

  std::vector<Object> objects_;
  BoundsTree tree_;         // over the bounds of the objects
  BoundsTree polygonTree_;  // over the bounds of the objects' large polygons
};

}  // namespace lamplighter
