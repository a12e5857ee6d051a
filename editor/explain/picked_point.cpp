#include "editor/explain/picked_point.h"

#include "renderer/scene/surface.h"
#include "renderer/scene/units.h"

namespace lamplighter {

PickedPoint inUnits(const PickedPoint& metres, float unit) {
  PickedPoint point = metres;
  point.position /= unit;
  return point;
}

std::optional<PickedPoint> surfaceAt(const RenderScene& scene, const RayCaster& rays,
                                     const View& metres, const vec2& pixel) {
  const View view = inUnits(metres, scene.unit);
  const vec3 direction = view.rayDirection(pixel.x, pixel.y);
  // As in the picture, surfaces nearer than the near plane are invisible.
  const float tNear = view.znear / glm::dot(direction, view.forward());
  const Hit hit = rays.intersect({view.eye, tNear, direction}, Surfaces::seen);
  if (!hit) return std::nullopt;
  const Surface s = surfaceAt(scene, hit.object, hit.triangle, hit.u, hit.v);
  const float side = glm::dot(s.geometricNormal, direction) < 0.0f ? 1.0f : -1.0f;
  return PickedPoint{scene.objects[hit.object].node, scene.unit * s.position, side * s.normal,
                     side * s.geometricNormal, scene.objects[hit.object].leftOutBy};
}

namespace {

// Normals transform by the inverse transpose, so that they stay perpendicular under non-uniform
// scale.
vec3 turned(const mat3& byInverse, const vec3& normal) {
  return glm::normalize(glm::transpose(byInverse) * normal);
}

}  // namespace

Anchor::Anchor(const Scene& scene, const PickedPoint& point) : local_(point) {
  const mat4 toWorld = worldMatrix(scene, point.node);
  local_.position = vec3(glm::inverse(toWorld) * vec4(point.position, 1.0f));
  local_.normal = turned(mat3(toWorld), point.normal);
  local_.geometricNormal = turned(mat3(toWorld), point.geometricNormal);
}

std::optional<PickedPoint> Anchor::placedIn(const Scene& scene) const {
  if (scene.find(local_.node) == nullptr) return std::nullopt;
  const mat4 toWorld = worldMatrix(scene, local_.node);
  const mat3 toLocal = glm::inverse(mat3(toWorld));
  return PickedPoint{local_.node, vec3(toWorld * vec4(local_.position, 1.0f)),
                     turned(toLocal, local_.normal), turned(toLocal, local_.geometricNormal),
                     local_.leftOutBy};
}

}  // namespace lamplighter
