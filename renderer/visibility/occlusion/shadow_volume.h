// Where the shadow of a moved object may fall: the part of space that its bounding sphere hides
// from a light. A cheap sieve before occlusion pyramids, the other way round than these look.
#pragma once

#include "renderer/base/math.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// What casts: all of it is in the box, and in a sphere around the middle of that, which may be
// smaller than the one around the box.
struct Caster {
  Bounds box;
  float radius = 0.0f;

  Caster() = default;
  explicit Caster(const Bounds& b) : box(b), radius(b.radius()) {}
  Caster(const Bounds& b, float r) : box(b), radius(r) {}
  Caster(const Caster& a, const Caster& b);  // both
};

class ShadowVolume {
 public:
  ShadowVolume() = default;  // none
  // An empty box casts none.
  ShadowVolume(const shared::Vpl& vpl, const Caster& caster);

  bool isEmpty() const { return kind_ == Kind::none; }
  // What mayFallOn() goes by where the light is not parallel, and what says by how much [m].
  struct Cone {
    vec3 apex, axis;
    float nearest, sine, cosine;  // nearest: from the apex; -infinity: the caster is over the light
    float before;                 // how far it reaches before the light's plane, and is over it
    float radius;                 // of the caster
  };
  Cone cone() const;
  // Whether the shadow may fall on some of a sphere: one no nearer than the caster's near side, and
  // no farther from the cone or cylinder than its radius. Conservative; and where it may, it may on
  // a sphere around that sphere, and that of a caster around this one may.
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
        // Behind the light, where no place of the cone is nearer than its apex.
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
  vec3 apex_{0.0f}, axis_{0.0f};  // a cylinder's apex is the middle of the caster
  float nearest_ = 0.0f;          // of the caster: from the apex; a cylinder: along the axis [m]
  float sine_ = 0.0f, cosine_ = 1.0f;
  float radius_ = 0.0f;
  float before_ = 0.0f;  // how far the caster reaches before the light's plane [m]
};

}  // namespace lamplighter
