#include "renderer/visibility/occlusion/shadow_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/raycast/ray_caster.h"

namespace lamplighter {

Caster::Caster(const Caster& a, const Caster& b) {
  for (const Caster* c : {&a, &b})
    if (!c->box.empty()) box.add(c->box);
  for (const Caster* c : {&a, &b})
    if (!c->box.empty())
      radius = std::max(radius, glm::distance(box.centre(), c->box.centre()) + c->radius);
}

ShadowVolume::ShadowVolume(const shared::Vpl& vpl, const Caster& caster) {
  const Bounds& box = caster.box;
  if (box.empty()) return;
  // The margin covers the offsets of rays at both ends and rounding errors.
  const vec3 centre = box.centre();
  const float margin = 16.0f * (rayEpsilon(box.min) + rayEpsilon(box.max));
  radius_ = 1.001f * caster.radius + margin;
  if (vpl.position.w == shared::kVplDirectional) {
    kind_ = Kind::cylinder;
    apex_ = centre;
    axis_ = -vec3(vpl.normal);
    nearest_ = -radius_;
    return;
  }
  apex_ = vec3(vpl.position);
  const vec3 v = centre - apex_;
  before_ = glm::dot(v, vec3(vpl.normal)) + radius_;
  if (before_ < 0.0f) return;  // behind the light
  const float distance = glm::length(v);
  if (distance <= 1.01f * radius_) {
    kind_ = Kind::everywhere;
    nearest_ = distance - 1.01f * radius_;
    return;
  }
  kind_ = Kind::cone;
  axis_ = v / distance;
  nearest_ = distance - radius_;
  sine_ = radius_ / distance;
  cosine_ = std::sqrt(1.0f - sine_ * sine_);
  // The rounding error grows with the distance from the light.
  sine_ = std::min(1.0f, 1.0001f * sine_ + 1e-6f);
}

ShadowVolume::Cone ShadowVolume::cone() const {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  if (kind_ == Kind::cone) return {apex_, axis_, nearest_, sine_, cosine_, before_, radius_};
  // Everywhere: minus infinity; empty: farther than anything.
  const bool isNone = kind_ == Kind::none;
  const float over = isNone ? 0.0f : std::min(-nearest_, before_);
  return {apex_, vec3(0.0f), isNone ? kFar : -kFar, 0.0f, 0.0f, over, radius_};
}

}  // namespace lamplighter
