#include "tests/support/scenes.h"

namespace lamplighter::test {

namespace {

void addQuad(Primitive& p, const vec3& corner, const vec3& u, const vec3& v) {
  const auto first = static_cast<uint32_t>(p.positions.size());
  const vec3 n = glm::normalize(glm::cross(u, v));
  for (const vec2& t : {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 1)}) {
    p.positions.push_back(corner + t.x * u + t.y * v);
    p.normals.push_back(n);
    p.uv0.push_back(t);
  }
  p.indices.insert(p.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

std::shared_ptr<const Mesh> meshOf(Primitive p, int material) {
  p.material = material;
  auto mesh = std::make_shared<Mesh>();
  mesh->primitives.push_back(std::move(p));
  return mesh;
}

}  // namespace

std::shared_ptr<const Mesh> squareMesh(float size, int material) {
  Primitive p;
  addQuad(p, vec3(-0.5f * size, 0, 0.5f * size), vec3(size, 0, 0), vec3(0, 0, -size));
  return meshOf(std::move(p), material);
}

std::shared_ptr<const Mesh> boxMesh(const vec3& size, int material) {
  Primitive p;
  const vec3 h = 0.5f * size;
  const vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  addQuad(p, vec3(-h.x, h.y, h.z), x, -z);   // top
  addQuad(p, vec3(-h.x, -h.y, -h.z), x, z);  // bottom
  addQuad(p, vec3(-h.x, -h.y, h.z), x, y);   // front
  addQuad(p, vec3(h.x, -h.y, -h.z), -x, y);  // back
  addQuad(p, vec3(h.x, -h.y, h.z), -z, y);   // right
  addQuad(p, vec3(-h.x, -h.y, -h.z), z, y);  // left
  return meshOf(std::move(p), material);
}

std::shared_ptr<const Mesh> roomMesh(const vec3& size, int material) {
  Mesh mesh = *boxMesh(size, material);
  Primitive& p = mesh.primitives[0];
  for (size_t i = 0; i < p.indices.size(); i += 3) std::swap(p.indices[i + 1], p.indices[i + 2]);
  for (vec3& n : p.normals) n = -n;
  return std::make_shared<const Mesh>(std::move(mesh));
}

NodeId addNode(Scene& scene, const std::string& name, NodeId parent, const vec3& at) {
  Node& node = scene.nodes.emplace_back();
  node.id = scene.nextId++;
  node.name = name;
  node.parent = parent;
  node.local.translation = at;
  return node.id;
}

NodeId addMesh(Scene& scene, std::shared_ptr<const Mesh> mesh, const vec3& at) {
  const NodeId id = addNode(scene, "mesh", kNoNode, at);
  scene.find(id)->mesh = static_cast<int>(scene.meshes.size());
  scene.meshes.push_back(std::move(mesh));
  return id;
}

NodeId addRectangleLight(Scene& scene, const vec3& at, const vec2& size, const vec3& radiance) {
  const NodeId id = addNode(scene, "light", kNoNode, at);
  Node& node = *scene.find(id);
  node.local.rotation = glm::angleAxis(-0.5f * kPi, vec3(1, 0, 0));  // −Z becomes −Y
  node.area = AreaLight{AreaShape::rectangle, radiance, size};
  return id;
}

int addMaterial(Scene& scene, const vec3& albedo, const vec3& emissive) {
  Material& m = scene.materials.emplace_back();
  m.baseColor = vec4(albedo, 1.0f);
  m.emissive = emissive;
  return static_cast<int>(scene.materials.size()) - 1;
}

}  // namespace lamplighter::test
