// The occlusion pyramid (paper 1, 4.3.1, figure 4-5): all segments from a light to the points of a
// patch. What does not meet it cannot cast a shadow of that light on the patch. A parallel light's
// is a prism without end; the patch is a rectangle or a box.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/patches/patch_set.h"
#include "renderer/visibility/occlusion/pyramid_planes.h"
#include "renderer/visibility/occlusion/shadow_volume.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// State of a light on a patch. Conservative: partial when unsure.
enum class Occlusion : uint8_t {
  none,     // nothing stands between the light and any point of the patch
  partial,  // something may
  full      // no point that is seen gets light of it: it is hidden, or one is behind the other
};

// A patch in the world: the corners of its convex hull.
struct PatchRegion {
  std::array<vec3, 8> corners{};
  int count = 0;           // 4: a rectangle, in order; 8: a box, bit c of the index chooses max[c]
  vec3 normal{0.0f};       // rectangle: unit
  float thickness = 0.0f;  // rectangle: the surface is within this of it [m]
  bool frontOnly = false;  // rectangle: its back is never seen
  int object = kNone, chart = kNone;  // a rough one's, whose bumps are not between: else kNone
  vec3 centre{0.0f};                  // of a sphere around it
  float radius = 0.0f;                // of that sphere [m]
  float rounding = 0.0f;              // what it may make of a place here [m]
  // Rectangle: corners and the sides from them to the next, all x, all y, all z.
  std::array<std::array<float, 4>, 3> from{}, sides{};

  explicit PatchRegion(const Bounds& box);
  PatchRegion(const RenderScene& scene, uint32_t object, const ObjectPatches& patches,
              const Patch& patch);
  bool isBox() const { return count == 8; }
  std::span<const vec3> points() const { return {corners.data(), static_cast<size_t>(count)}; }
  vec3 middle() const { return 0.5f * (corners[0] + corners[isBox() ? 7 : 2]); }
};

// A convex polygon that may hide whole patches, with what is asked of it for every pyramid.
struct OccluderPolygon {
  struct Edge {
    vec3 inwards{0.0f};   // in its plane, as long as the edge
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
  // Refers to both, which must outlive it.
  OcclusionPyramid(const shared::Vpl& vpl, const PatchRegion& region);
  OcclusionPyramid(const shared::Vpl& vpl, PatchRegion&& region) = delete;

  // No point of the patch is on the lit side of the light, or the light is behind all that is seen.
  bool isDark() const { return dark_; }
  // The light is so near the patch or its plane that nothing can be said.
  bool isDegenerate() const { return degenerate_; }

  // Whether the shadow of it may fall on the patch: a sieve before the tests below, and part of
  // them, for these take a little more than the pyramid.
  bool mayBeShadowedBy(const Caster& caster) const {
    return ShadowVolume(vpl_, caster).mayFallOn(region_.centre, region_.radius);
  }

  // It is that of a patch of this chart, which is rough.
  bool isOfRough(uint32_t object, int chart) const {
    return region_.object == static_cast<int>(object) && region_.chart == chart;
  }

  // Its patch is a box around triangles, not a rectangle.
  bool isOfBox() const { return region_.isBox(); }

  // Whether it may be met; exact for triangles but for a margin of rounding.
  bool mayMeet(const Bounds& box) const;
  bool mayMeetSphere(const vec3& centre, float radius) const;
  // `at`: a point of what is met, if so.
  bool meets(const vec3& a, const vec3& b, const vec3& c, vec3* at = nullptr) const {
    return planes_.meet(a, b, c, at);
  }
  // Whether a point is in it, by more than rounding.
  bool holds(const vec3& point) const { return !mayBeOutside(point, margin_); }
  // Whether a polygon stands wholly across it, between light and patch.
  bool isCutBy(const OccluderPolygon& polygon) const;

  // The segment from the middle of the patch to the light. Only what that meets can stand across
  // all of the pyramid, and it meets far less.
  class Axis {
   public:
    explicit Axis(const OcclusionPyramid& pyramid);
    bool mayMeet(const Bounds& box) const {
      const vec3 a = (box.min - high_) * inverse_, b = (box.max - low_) * inverse_;
      const vec3 enter = glm::min(a, b), leave = glm::max(a, b);
      const float first = std::max({enter.x, enter.y, enter.z, 0.0f});
      return first <= std::min({leave.x, leave.y, leave.z, last_});
    }

   private:
    vec3 low_, high_;  // its beginning, give or take the margin
    vec3 inverse_;     // one over its length on each axis
    float last_;       // where it ends, in lengths
  };

 private:
  bool mayBeOutside(const vec3& point, float margin) const;

  void addSides(const vec3& middle, const vec3& up);
  void add(const vec3& normal, const vec3& on, float margin);

  const shared::Vpl& vpl_;
  const PatchRegion& region_;
  bool parallel_ = false, dark_ = false, degenerate_ = false;
  vec3 apex_{0.0f};      // a parallel light: unused
  vec3 towards_{0.0f};   // the light's axis; a parallel light: unit, towards the light
  float margin_ = 0.0f;  // what rounding may make of a place here [m]
  PyramidPlanes planes_;
  int count_ = 0;
};

}  // namespace lamplighter
