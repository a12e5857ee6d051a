#include "renderer/surface_light/own_mesh.h"

namespace lamplighter {

OwnMesh::OwnMesh(const RenderScene& scene, uint32_t object)
    : scene_(scene), object_(scene.objects[object]), shape_(shapeOf(object_)) {
  for (uint32_t v = 0; v < object_.vertexCount; ++v) bounds_.add(position(v));
}

vec3 OwnMesh::cross(uint32_t triangle) const {
  const vec3 a = position(corner(triangle, 0));
  const vec3 out = glm::cross(position(corner(triangle, 1)) - a, position(corner(triangle, 2)) - a);
  return shape_.mirrored ? -out : out;
}

vec3 OwnMesh::normal(uint32_t triangle) const {
  const vec3 n = cross(triangle);
  const float length = glm::length(n);
  return length > 0.0f ? n / length : vec3(0.0f);
}

OwnMesh::Vertex OwnMesh::vertex(uint32_t triangle, uint32_t corner, bool isBack) const {
  const uint32_t v = this->corner(triangle, corner);
  const vec3 flat = normal(triangle);
  vec3 n = scene_.localNormals[object_.firstVertex + v] / shape_.scale;
  const float length = glm::length(n);
  n = length > 0.0f ? n / length : flat;
  if (glm::dot(n, flat) <= 0.0f) n = flat;
  return {position(v), isBack ? -n : n};
}

}  // namespace lamplighter
