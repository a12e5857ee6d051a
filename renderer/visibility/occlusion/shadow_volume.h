// The region where the shadow of a moved object may fall: the part of space that its bounding
// sphere hides from a light. A cheap conservative test before occlusion pyramids; it starts at the
// occluder, pyramids start at the patch.
#pragma once

#include "renderer/base/math.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// Bounds of an occluder: a box, and a sphere around the centre of the box that may be smaller than
// the bounding sphere of the box.
struct Caster {
  Bounds box;
  float radius = 0.0f;

  Caster() = default;
  explicit Caster(const Bounds& b) : box(b), radius(b.radius()) {}
  Caster(const Bounds& b, float r) : box(b), radius(r) {}
  Caster(const Caster& a, const Caster& b);  // bounds of both
};

class ShadowVolume {
 public:
  ShadowVolume() = default;  // empty
  // An empty box casts no shadow.
  ShadowVolume(const shared::Vpl& vpl, const Caster& caster);

  bool isEmpty() const { return kind_ == Kind::none; }
  // The data of mayFallOn() and of the slack for a non-parallel light [m].
  struct Cone {
    vec3 apex, axis;
    float nearest, sine, cosine;  // distance from the apex; -infinity: the caster surrounds the
                                  // light
    float before;                 // how far the caster extends in front of the light's plane, and
                                  // how far it surrounds the light
    float radius;                 // of the caster
  };
  Cone cone() const;
  // Whether the shadow may fall on part of a sphere: the sphere is not nearer than the near side of
  // the caster, and its distance from the cone or cylinder is at most its radius. Conservative and
  // monotonic: if true, it is also true for a larger sphere that contains this one, and for a
  // larger caster.
  bool mayFallOn(const vec3& centre, float radius) const {
    switch (kind_) {
      case Kind::none:
        return false;
      case Kind::everywhere:
        return true;
      case Kind::cone: {
        const vec3 v = centre - apex_;
        const float distance2 = glm::dot(v, v), gap = nearest_ - radius;
        if (gap > 0.0f && distance2 < gap * gap) return false;
        const float along = glm::dot(v, axis_);
        const float across2 = std::max(distance2 - along * along, 0.0f);
        const float cosine2 = cosine_ * cosine_;
        // Behind the light, where the apex is the nearest point of the cone.
        if (along < 0.0f && across2 * sine_ * sine_ <= along * along * cosine2)
          return distance2 <= radius * radius;
        const float reach = radius + along * sine_;
        return reach >= 0.0f && across2 * cosine2 <= reach * reach;
      }
      case Kind::cylinder: {
        const vec3 v = centre - apex_;
        const float along = glm::dot(v, axis_);
        if (along + radius < nearest_) return false;
        const float reach = radius_ + radius;
        return glm::dot(v, v) - along * along <= reach * reach;
      }
    }
    return true;
  }

 private:
  enum class Kind : uint8_t { none, everywhere, cone, cylinder };
  Kind kind_ = Kind::none;
  vec3 apex_{0.0f}, axis_{0.0f};  // a cylinder's apex is the centre of the caster
  float nearest_ = 0.0f;          // near side of the caster: distance from the apex; cylinder:
                                  // along the axis [m]
  float sine_ = 0.0f, cosine_ = 1.0f;
  float radius_ = 0.0f;
  float before_ = 0.0f;  // how far the caster extends in front of the light's plane [m]
};

}  // namespace lamplighter
