// The region where the shadow of a moved object may fall: the part of space that its bounding
// sphere hides from a light. A cheap conservative test before occlusion pyramids; it starts at the
// occluder, pyramids start at the patch.
#pragma once

#include <limits>

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

  bool isEmpty() const {
    return !isParallel_ && cone_.nearest == std::numeric_limits<float>::infinity();
  }
  // For a light that is not parallel: the cone around the caster from the light, all of space if
  // the caster surrounds the light. For a parallel light: the cylinder around the caster.
  struct Cone {
    vec3 apex{0.0f};  // the light; cylinder: centre of the caster
    vec3 axis{0.0f};  // unit, away from the light; zero: all of space
    // Near side of the caster: distance from the apex; cylinder: along the axis. Infinity: empty;
    // -infinity: all of space. [m]
    float nearest = std::numeric_limits<float>::infinity();
    float sine = 0.0f, cosine = 0.0f;  // of half the opening angle
    float before = 0.0f;               // how far the caster extends in front of the light's plane;
                                       // all of space: at most how far it surrounds the light [m]
    float radius = 0.0f;               // of the caster [m]
  };
  const Cone& cone() const { return cone_; }
  // Whether the shadow may fall on part of a sphere: the sphere is not nearer than the near side of
  // the caster, and its distance from the cone or cylinder is at most its radius. Conservative and
  // monotonic: if true, it is also true for a larger sphere that contains this one, and for a
  // larger caster.
  bool mayFallOn(const vec3& centre, float radius) const;

 private:
  bool isParallel_ = false;
  Cone cone_;
};

}  // namespace lamplighter
