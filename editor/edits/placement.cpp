#include "editor/edits/placement.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {

namespace {

constexpr float kLift = 0.01f;  // units: what a light is kept off, so that it is not hidden in it

// How far the node's area light reaches along −n from its own origin, in metres: the support
// function of its shape, with the node's scale and shear.
float reachBelow(const AreaLight& light, const mat3& world, const vec3& n) {
  const vec3 local = 0.5f * (glm::transpose(world) * n);
  switch (light.shape) {
    case AreaShape::rectangle:
      return std::abs(local.x) * light.size.x + std::abs(local.y) * light.size.y;
    case AreaShape::disk:
      return light.size.x * glm::length(vec2(local));
    case AreaShape::sphere:
      return light.size.x * glm::length(local);
    case AreaShape::tube:
      return std::abs(local.x) * light.size.x + light.size.y * glm::length(vec2(local.y, local.z));
  }
  return 0.0f;
}

}  // namespace

quat leastTurn(const vec3& from, const vec3& to) {
  const float cosine = glm::dot(from, to);
  // Right round: about any axis across.
  if (cosine < -0.9999f) return glm::angleAxis(kPi, Frame(from).tangent);
  return glm::normalize(quat(1.0f + cosine, glm::cross(from, to)));
}

bool hasVolume(const mat4& m) {
  const mat3 a(m);
  const float sides = glm::length(a[0]) * glm::length(a[1]) * glm::length(a[2]);
  return sides > 0.0f && std::abs(glm::determinant(a)) > 1e-6f * sides;
}

float standOff(const Scene& scene, NodeId id, const vec3& n, float unit) {
  const float lift = kLift * unit;
  const std::vector<mat4> world = worldMatrices(scene);
  const vec3 origin = vec3(worldMatrix(scene, id)[3]);
  float lowest = std::numeric_limits<float>::infinity();
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (node.mesh == kNone && !node.area && !node.punctual) continue;
    bool mine = node.id == id;
    for (const Node* p = scene.find(node.parent); p != nullptr && !mine; p = scene.find(p->parent))
      mine = p->id == id;
    if (!mine) continue;
    const float height = glm::dot(vec3(world[i][3]) - origin, n);
    if (node.area)
      lowest = std::min(lowest, height - reachBelow(*node.area, mat3(world[i]), n) - lift);
    if (node.punctual) lowest = std::min(lowest, height - lift);
    if (node.mesh == kNone) continue;
    for (const Primitive& primitive : scene.meshes[static_cast<size_t>(node.mesh)]->primitives) {
      for (const vec3& q : primitive.positions)
        lowest = std::min(lowest, glm::dot(vec3(world[i] * vec4(q, 1.0f)) - origin, n));
    }
  }
  return std::isfinite(lowest) ? -lowest : 0.0f;
}

std::optional<Transform> placedOn(const Scene& scene, NodeId id, const SurfacePoint& at,
                                  float unit) {
  const Node& node = *scene.find(id);
  const mat4 parent = worldMatrix(scene, node.parent);
  if (!hasVolume(parent)) return std::nullopt;
  Transform local = node.local;
  float off = 0.0f;
  if (node.area || node.punctual) {
    const Frame f(-at.normal);  // −Z of the light along the normal: Z along −normal
    const quat world = glm::quat_cast(mat3(f.tangent, f.bitangent, f.normal));
    local.rotation = glm::normalize(glm::inverse(decompose(parent).rotation) * world);
    Scene turned = scene;  // meshes are shared: cheap
    turned.find(id)->local = local;
    off = standOff(turned, id, at.normal, unit);
  } else {
    off = standOff(scene, id, at.normal, unit);
  }
  local.translation = vec3(glm::inverse(parent) * vec4(at.position + off * at.normal, 1.0f));
  return local;
}

}  // namespace lamplighter
