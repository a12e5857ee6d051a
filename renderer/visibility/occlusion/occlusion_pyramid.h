// The occlusion pyramid (paper 1, 4.3.1, figure 4-5): the union of all segments from a light to the
// points of a patch. Geometry outside it cannot cast a shadow of that light on the patch. For a
// parallel light it is an infinite prism. The patch is a rectangle or a box.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/patches/patch_set.h"
#include "renderer/visibility/occlusion/light_packet.h"
#include "renderer/visibility/occlusion/occlusion.h"
#include "renderer/visibility/occlusion/pyramid_planes.h"
#include "renderer/visibility/occlusion/shadow_volume.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// A patch in world space: the corners of its convex hull.
struct PatchRegion {
  std::array<vec3, 8> corners{};
  int count = 0;           // 4: rectangle, in order; 8: box, bit c of the index selects max[c]
  vec3 normal{0.0f};       // rectangle: unit
  float thickness = 0.0f;  // rectangle: largest distance of the surface from it [m]
  bool frontOnly = false;  // rectangle: its back is never visible
  int object = kNone, chart = kNone;  // set for a rough chart, whose bumps do not block its own
                                      // light; otherwise kNone
  vec3 centre{0.0f};                  // of a bounding sphere
  float radius = 0.0f;                // of the bounding sphere [m]
  float rounding = 0.0f;              // rounding error of positions here [m]
  // Rectangle: corners and edges to the next corner, as arrays of x, y and z.
  std::array<std::array<float, 4>, 3> from{}, sides{};

  explicit PatchRegion(const Bounds& box);
  PatchRegion(const RenderScene& scene, uint32_t object, const ObjectPatches& patches,
              const Patch& patch);
  bool isBox() const { return count == 8; }
  std::span<const vec3> points() const { return {corners.data(), static_cast<size_t>(count)}; }
  vec3 middle() const { return 0.5f * (corners[0] + corners[isBox() ? 7 : 2]); }
};

// A convex polygon that may hide whole patches, with the data that each pyramid test needs.
struct OccluderPolygon {
  struct Edge {
    vec3 inwards{0.0f};   // in the plane of the polygon, with the length of the edge
    float length = 0.0f;  // [m]
  };
  std::vector<vec3> corners;
  std::vector<Edge> edges;  // from each corner to the next
  vec3 normal{0.0f};        // unit
  Bounds box;

  OccluderPolygon(std::span<const vec3> corners, const vec3& normal);
};

class OcclusionPyramid {
 public:
  // Keeps references to both arguments, which must outlive this object.
  OcclusionPyramid(const shared::Vpl& vpl, const PatchRegion& region);
  OcclusionPyramid(const shared::Vpl& vpl, PatchRegion&& region) = delete;

  // No point of the patch is in front of the light, or the light is behind all visible points.
  bool isDark() const { return isDark_; }
  // The light is so close to the patch or its plane that the test is not reliable.
  bool isDegenerate() const { return isDegenerate_; }

  // Whether the shadow of the caster may fall on the patch. A cheap test before those below; it
  // also decides together with them, because they cover slightly more than the exact pyramid.
  bool mayBeShadowedBy(const Caster& caster) const {
    return ShadowVolume(vpl_, caster).mayFallOn(region_.centre, region_.radius);
  }

  // Whether the patch belongs to this chart and the chart is rough.
  bool isOfRough(uint32_t object, int chart) const {
    return region_.object == static_cast<int>(object) && region_.chart == chart;
  }

  const PyramidApex& light() const { return light_; }
  const PatchRegion& region() const { return region_; }

  // Whether the patch is a box around triangles, not a rectangle.
  bool isOfBox() const { return region_.isBox(); }

  // Conservative intersection tests; exact for triangles except for a margin for rounding errors.
  bool mayMeet(const Bounds& box) const { return planes_.mayMeet(box); }
  bool mayMeetSphere(const vec3& centre, float radius) const {
    return planes_.reach(centre, -radius);
  }
  // `at`: receives a point of the intersection, if there is one.
  bool meets(const vec3& a, const vec3& b, const vec3& c, vec3* at = nullptr) const {
    return planes_.meet(a, b, c, at);
  }
  // Whether the point is inside by more than the rounding error.
  bool holds(const vec3& point) const { return planes_.reach(point, margin_); }

 private:
  void add(const vec3& normal, float offset);
  void addPatchSides(const vec3& up);

  const shared::Vpl& vpl_;
  const PatchRegion& region_;
  PyramidApex light_;
  bool isDark_, isDegenerate_;
  float margin_;  // rounding error of positions here [m]
  PyramidPlanes planes_;
  int count_ = 0;
};

}  // namespace lamplighter
