#include "editor/tools/picker.h"

#include "editor/tools/projection.h"

namespace lamplighter {

NodeId pick(const View& view, const RenderScene& scene, const RayCaster& rays, const vec2& pointer,
            const std::function<bool(NodeId)>& mayPick) {
  // Skips surfaces that cannot be picked.
  constexpr int kMostPassed = 256;
  Ray ray{view.eye, 0.0f, view.rayDirection(pointer.x, pointer.y)};
  Hit hit = rays.intersect(ray, Surfaces::seen);
  for (int i = 0; i < kMostPassed && hit && !mayPick(scene.objects[hit.object].node); ++i) {
    ray.tNear = hit.t + rayEpsilon(ray.origin + hit.t * ray.direction);
    hit = rays.intersect(ray, Surfaces::seen);
  }
  if (hit && !mayPick(scene.objects[hit.object].node)) hit = {};
  NodeId best = hit ? scene.objects[hit.object].node : kNoNode;
  float nearest = hit ? hit.t : std::numeric_limits<float>::infinity();
  for (const RenderPunctual& light : scene.punctuals) {
    const auto mark = projectPoint(view, light.position);
    const float distance = glm::length(light.position - view.eye);
    if (mark && mayPick(light.node) && glm::length(*mark - pointer) <= kMarkRadius &&
        distance < nearest) {
      nearest = distance;
      best = light.node;
    }
  }
  return best;
}

}  // namespace lamplighter
