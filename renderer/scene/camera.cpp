#include "renderer/scene/camera.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace lamplighter {

mat4 View::worldToView() const {
  const mat3 rotation = glm::transpose(glm::mat3_cast(orientation));
  mat4 m(rotation);
  m[3] = vec4(-(rotation * eye), 1.0f);
  return m;
}

mat4 View::viewToClip() const {
  const float f = 1.0f / std::tan(0.5f * yfov);
  mat4 m(0.0f);
  m[0][0] = f / aspect();
  m[1][1] = f;
  m[2][3] = -1.0f;
  m[3][2] = znear;
  return m;
}

vec3 View::rayDirection(float x, float y) const { return glm::normalize(rayPlane(x, y)); }

vec3 View::rayPlane(float x, float y) const {
  const float t = std::tan(0.5f * yfov);
  const float sx = (2.0f * x / static_cast<float>(width) - 1.0f) * t * aspect();
  const float sy = (1.0f - 2.0f * y / static_cast<float>(height)) * t;
  return orientation * vec3(sx, sy, -1.0f);
}

vec3 View::project(const vec3& world) const {
  const vec3 p = vec3(worldToView() * vec4(world, 1.0f));
  const float depth = -p.z;
  const float scale = 0.5f * static_cast<float>(height) / (std::tan(0.5f * yfov) * depth);
  return {0.5f * static_cast<float>(width) + p.x * scale,
          0.5f * static_cast<float>(height) - p.y * scale, depth};
}

View viewOfCamera(const Scene& scene, const Node& node, int width, int height) {
  View view;
  view.width = width;
  view.height = height;
  const mat4 world = worldMatrix(scene, node.id);
  view.eye = vec3(world[3]);
  // Scale and shear of the node only affect the directions of the axes.
  const vec3 back = glm::normalize(vec3(world[2]));
  const vec3 right = glm::normalize(glm::cross(vec3(world[1]), back));
  view.orientation = glm::normalize(glm::quat_cast(mat3(right, glm::cross(back, right), back)));
  if (node.camera != kNone) {
    const Camera& camera = scene.cameras[node.camera];
    view.yfov = camera.yfov;
    view.znear = camera.znear;
  }
  return view;
}

View viewOfBounds(const Bounds& bounds, int width, int height) {
  View view;
  view.width = width;
  view.height = height;
  const vec3 back = glm::normalize(vec3(0.6f, 0.45f, 1.0f));
  const vec3 right = glm::normalize(glm::cross(vec3(0, 1, 0), back));
  view.orientation = glm::normalize(glm::quat_cast(mat3(right, glm::cross(back, right), back)));
  // The smallest distance at which every corner of the box is visible: a corner at p (relative to
  // the centre) is in the picture if |p·right| and |p·up| are within the frustum at its depth.
  const float radius = bounds.radius() > 0.0f ? bounds.radius() : 1e-3f;
  const float vertical = std::tan(0.5f * view.yfov), horizontal = vertical * view.aspect();
  const vec3 half = 0.5f * bounds.extent();
  float distance = 0.0f;
  for (int i = 0; i < 8; ++i) {
    const vec3 p = half * vec3((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1);
    const float towardsEye = glm::dot(p, back);
    distance = std::max({distance, towardsEye + std::abs(glm::dot(p, right)) / horizontal,
                         towardsEye + std::abs(glm::dot(p, view.up())) / vertical});
  }
  view.eye = bounds.centre() + back * std::max(1.05f * distance, radius * 0.1f);
  view.znear = 0.001f * radius;
  return view;
}

}  // namespace lamplighter
