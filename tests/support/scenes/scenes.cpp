#include "tests/support/scenes/scenes.h"

#include <cmath>

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

std::shared_ptr<const Mesh> sphereMesh(float radius, uint32_t rings, float bump, int material) {
  const auto at = [&](float theta, float phi) {
    const float wave = std::sin(6.0f * theta) * std::sin(5.0f * phi) * std::sin(theta);
    return radius * (1.0f + bump * wave) *
           vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
  };
  Primitive p;
  const uint32_t around = 2 * rings;
  for (uint32_t i = 0; i <= rings; ++i) {
    for (uint32_t j = 0; j <= around; ++j) {
      const float theta = kPi * static_cast<float>(i) / static_cast<float>(rings);
      // The first and the last vertex of a ring have the same position.
      const float phi = 2.0f * kPi * static_cast<float>(j % around) / static_cast<float>(around);
      constexpr float kStep = 1e-3f;
      const bool isPole = i == 0 || i == rings;
      const vec3 n = isPole ? vec3(0.0f, i == 0 ? 1.0f : -1.0f, 0.0f)
                            : glm::cross(at(theta, phi + kStep) - at(theta, phi - kStep),
                                         at(theta + kStep, phi) - at(theta - kStep, phi));
      p.positions.push_back(isPole ? radius * n : at(theta, phi));
      p.normals.push_back(glm::normalize(n));
      p.uv0.emplace_back(phi / (2.0f * kPi), theta / kPi);
    }
  }
  for (uint32_t i = 0; i < rings; ++i) {
    for (uint32_t j = 0; j < around; ++j) {
      const uint32_t a = i * (around + 1) + j, b = a + 1, c = a + around + 1, d = c + 1;
      if (i > 0) p.indices.insert(p.indices.end(), {a, b, d});
      if (i + 1 < rings) p.indices.insert(p.indices.end(), {a, d, c});
    }
  }
  return meshOf(std::move(p), material);
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
  m.metallic = 0.0f;
  m.emissive = emissive;
  return static_cast<int>(scene.materials.size()) - 1;
}

int addMaterial(Scene& scene, const vec3& colour, float metallic, float roughness) {
  const int index = addMaterial(scene, colour);
  scene.materials.back().metallic = metallic;
  scene.materials.back().roughness = roughness;
  return index;
}

RenderScene renderSceneOf(const Scene& scene) {
  RenderScene render;
  update(render, scene, SceneChanges::all());
  return render;
}

RenderSceneChanges everythingRebuilt() {
  RenderSceneChanges changes;
  changes.rebuilt = true;
  return changes;
}

}  // namespace lamplighter::test
