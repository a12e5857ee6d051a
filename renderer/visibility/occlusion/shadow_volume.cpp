#include "renderer/visibility/occlusion/shadow_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/raycast/ray_caster.h"
#include "renderer/visibility/occlusion/cone_lanes.h"

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
  const float radius = 1.001f * caster.radius + margin;
  cone_.radius = radius;
  if (vpl.position.w == shared::kVplDirectional) {
    isParallel_ = true;
    cone_.apex = centre;
    cone_.axis = -vec3(vpl.normal);
    cone_.nearest = -radius;
    return;
  }
  cone_.apex = vec3(vpl.position);
  const vec3 v = centre - cone_.apex;
  const float before = glm::dot(v, vec3(vpl.normal)) + radius;
  if (before < 0.0f) return;  // behind the light
  const float distance = glm::length(v);
  if (distance <= 1.01f * radius) {
    cone_.nearest = -std::numeric_limits<float>::infinity();
    cone_.before = std::min(1.01f * radius - distance, before);
    return;
  }
  cone_.axis = v / distance;
  cone_.nearest = distance - radius;
  cone_.before = before;
  const float sine = radius / distance;
  cone_.cosine = std::sqrt(1.0f - sine * sine);
  // The rounding error grows with the distance from the light.
  cone_.sine = std::min(1.0f, 1.0001f * sine + 1e-6f);
}

bool ShadowVolume::mayFallOn(const vec3& centre, float radius) const {
  if (!isParallel_) {
    const OneLight tag;
    const ConeLanes<OneLight> lanes{setLanes(tag, cone_.apex), setLanes(tag, cone_.axis),
                                    setLanes(tag, cone_.nearest), setLanes(tag, cone_.sine),
                                    setLanes(tag, cone_.cosine)};
    return conesMayFallOn(lanes, centre, radius) != 0;
  }
  const vec3 v = centre - cone_.apex;
  const float along = glm::dot(v, cone_.axis);
  if (along + radius < cone_.nearest) return false;
  const float reach = cone_.radius + radius;
  return glm::dot(v, v) - along * along <= reach * reach;
}

}  // namespace lamplighter
