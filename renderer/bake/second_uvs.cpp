#include "renderer/bake/second_uvs.h"

#include <map>
#include <utility>

#include "renderer/bake/node_meshes.h"
#include "renderer/base/error.h"

namespace lamplighter {
namespace {

bool usesSecondUvs(const Material& m) {
  for (const TextureRef* t :
       {&m.baseColorTexture, &m.normalTexture, &m.emissiveTexture, &m.metallicRoughnessTexture})
    if (t->texture != kNone && t->texCoord == 1) return true;
  return false;
}

template <typename T>
void copyVertex(std::vector<T>& to, const std::vector<T>& from, uint32_t vertex) {
  if (!from.empty()) to.push_back(from[vertex]);
}

// `charts`: those of this primitive, which is object `o` of the rendered scene.
Primitive withUvs(const Primitive& p, const RenderScene& render, const RenderObject& o,
                  const std::vector<const ObjectChart*>& charts, int pageSize) {
  std::vector<const ObjectChart*> chartOf(o.triangleCount(), nullptr);
  for (const ObjectChart* c : charts)
    for (const uint32_t t : c->chart.triangles) chartOf[t] = c;
  Primitive out;
  out.material = p.material;
  std::map<std::pair<uint32_t, const ObjectChart*>, uint32_t> vertices;
  std::vector<std::pair<uint32_t, const ObjectChart*>> order;
  for (uint32_t i = 0; i < o.indexCount; ++i) {
    const uint32_t vertex = p.indices[i];
    const ObjectChart* chart = chartOf[i / 3];
    const auto [it, isNew] =
        vertices.emplace(std::pair(vertex, chart), static_cast<uint32_t>(vertices.size()));
    if (isNew) order.emplace_back(vertex, chart);
    out.indices.push_back(it->second);
  }
  for (const auto& [vertex, chart] : order) {
    copyVertex(out.positions, p.positions, vertex);
    copyVertex(out.normals, p.normals, vertex);
    copyVertex(out.tangents, p.tangents, vertex);
    copyVertex(out.uv0, p.uv0, vertex);
    copyVertex(out.colors, p.colors, vertex);
    const vec3& at = render.positions[o.firstVertex + vertex];
    out.uv1.push_back(chart == nullptr ? vec2(0.0f)  // a triangle without area
                                       : chart->texelsOf(at) / static_cast<float>(pageSize));
  }
  return out;
}

}  // namespace

Scene withLightMapUvs(const Scene& scene, const RenderScene& render, const LightMapAtlas& atlas) {
  std::map<uint32_t, std::vector<const ObjectChart*>> byObject;
  for (const ObjectChart& c : atlas.charts) byObject[c.object].push_back(&c);
  Scene out = scene;
  MeshReplacement replacement(out);
  for (const NodeMesh& of : nodeMeshes(scene, render)) {
    const Mesh& was = *scene.meshes[static_cast<size_t>(scene.nodes[of.node].mesh)];
    std::shared_ptr<Mesh> mesh;
    int page = 0;
    for (const auto& [primitive, object] : of.parts) {
      const auto charts = byObject.find(object);
      if (charts == byObject.end()) continue;
      const Primitive& p = was.primitives[primitive];
      if (p.material != kNone && usesSecondUvs(scene.materials[static_cast<size_t>(p.material)]))
        throw InputError(
            "material \"" + scene.materials[static_cast<size_t>(p.material)].name + "\"",
            "one of its textures uses the second UV set, which the light maps need",
            "let the texture use the first UV set");
      if (!mesh) mesh = std::make_shared<Mesh>(was);
      page = charts->second.front()->page;
      mesh->primitives[primitive] =
          withUvs(p, render, render.objects[object], charts->second, atlas.pageSize);
    }
    if (!mesh) continue;
    mesh->name +=
        (mesh->name.empty() ? "(light map " : " (light map ") + std::to_string(page) + ")";
    replacement.replace(of.node, std::move(mesh));
  }
  return out;
}

}  // namespace lamplighter
