#include "editor/tools/picker.h"

#include "editor/tools/projection.h"

namespace lamplighter {

NodeId pick(const View& view, const RenderScene& scene, const RayCaster& rays,
            const vec2& pointer) {
  const Hit hit =
      rays.intersect({view.eye, 0.0f, view.rayDirection(pointer.x, pointer.y)}, Surfaces::seen);
  NodeId best = hit ? scene.objects[hit.object].node : kNoNode;
  float nearest = hit ? hit.t : std::numeric_limits<float>::infinity();
  for (const RenderPunctual& light : scene.punctuals) {
    const auto mark = projectPoint(view, light.position);
    const float distance = glm::length(light.position - view.eye);
    if (mark && glm::length(*mark - pointer) <= kMarkRadius && distance < nearest) {
      nearest = distance;
      best = light.node;
    }
  }
  return best;
}

}  // namespace lamplighter
