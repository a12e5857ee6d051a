#include "editor/tools/surface_search.h"

#include <algorithm>
#include <limits>

#include "editor/tools/projection.h"
#include "renderer/scene/surface.h"

namespace lamplighter {

bool SurfaceSearch::isIgnored(NodeId id) const {
  for (const Node* n = document.scene.find(id); n != nullptr; n = document.scene.find(n->parent)) {
    if (std::find(ignored.begin(), ignored.end(), n->id) != ignored.end()) return true;
  }
  return false;
}

std::optional<Hit> SurfaceSearch::hitAlong(const vec3& eye, const vec3& direction) const {
  Ray ray{eye / scene.unit, 0.0f, direction};
  constexpr int kMostLayers = 1000;  // of consecutive ignored surfaces
  for (int i = 0; i < kMostLayers; ++i) {
    const Hit hit = rays.intersect(ray, Surfaces::seen);
    if (!hit) return std::nullopt;
    if (!isIgnored(scene.objects[hit.object].node)) return hit;
    ray.tNear = hit.t + rayEpsilon(ray.origin + hit.t * direction);
  }
  return std::nullopt;
}

std::optional<SurfacePoint> SurfaceSearch::along(const vec3& eye, const vec3& direction) const {
  const auto hit = hitAlong(eye, direction);
  if (!hit) return std::nullopt;
  const Surface s = surfaceAt(scene, hit->object, hit->triangle, hit->u, hit->v);
  const bool front = glm::dot(s.geometricNormal, direction) < 0.0f;
  return SurfacePoint{scene.unit * s.position, front ? s.geometricNormal : -s.geometricNormal};
}

std::optional<vec3> SurfaceSearch::vertexAt(const View& view, const vec2& pointer) const {
  const auto hit = hitAlong(view.eye, view.rayDirection(pointer.x, pointer.y));
  if (!hit) return std::nullopt;
  const uint32_t* corner =
      &scene.indices[scene.objects[hit->object].firstIndex + 3 * hit->triangle];
  std::optional<vec3> best;
  float nearest = std::numeric_limits<float>::infinity();
  for (int i = 0; i < 3; ++i) {
    const vec3 place = scene.unit * scene.positions[corner[i]];
    const auto point = projectPoint(view, place);
    if (!point || glm::length(*point - pointer) >= nearest) continue;
    nearest = glm::length(*point - pointer);
    best = place;
  }
  return best;
}

}  // namespace lamplighter
