#include "editor/bake/vertex_colour_job.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "renderer/base/atomic_file.h"
#include "renderer/base/error.h"
#include "renderer/frame/world.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {
namespace {

// All nodes with a mesh, without transparent panes, which receive no light.
std::vector<NodeMesh> litNodes(const Scene& scene, const RenderScene& render) {
  std::vector<NodeMesh> nodes = nodeMeshes(scene, render);
  for (NodeMesh& node : nodes)
    std::erase_if(node.parts, [&](const NodeMesh::Part& part) {
      const RenderObject& o = render.objects[part.object];
      return render.materials[static_cast<size_t>(o.material)].isClear();
    });
  std::erase_if(nodes, [](const NodeMesh& node) { return node.parts.empty(); });
  return nodes;
}

size_t trianglesOf(const Mesh& mesh) {
  size_t count = 0;
  for (const Primitive& p : mesh.primitives) count += p.indices.size() / 3;
  return count;
}

// Whether two meshes with the same source have the same division and light.
bool isLitAlike(const Mesh& a, const Mesh& b) {
  return std::ranges::equal(a.primitives, b.primitives, [](const Primitive& p, const Primitive& q) {
    return p.indices == q.indices && p.colors == q.colors;
  });
}

// Gives nodes their meshes; nodes that are lit alike share one.
class LitMeshes {
 public:
  LitMeshes(Scene& copy) : copy_(copy), replacement_(copy) {}
  void add(size_t node, std::shared_ptr<Mesh> mesh) {
    auto& known = bySource_[copy_.nodes[node].mesh];
    for (const auto& [index, other] : known) {
      if (!isLitAlike(*mesh, *other)) continue;
      copy_.nodes[node].mesh = index;
      return;
    }
    known.emplace_back(replacement_.replace(node, mesh), mesh);
    all_.push_back(std::move(mesh));
  }
  const std::vector<std::shared_ptr<Mesh>>& all() const { return all_; }

 private:
  Scene& copy_;
  MeshReplacement replacement_;
  std::map<int, std::vector<std::pair<int, std::shared_ptr<const Mesh>>>> bySource_;
  std::vector<std::shared_ptr<Mesh>> all_;
};

template <typename F>
void forEachColour(const std::vector<std::shared_ptr<Mesh>>& meshes, const F& f) {
  for (const auto& mesh : meshes)
    for (Primitive& p : mesh->primitives)
      for (vec4& c : p.colors) f(c);
}

void scaleColours(const std::vector<std::shared_ptr<Mesh>>& meshes,
                  const std::optional<float>& exposure, LitScene& out) {
  float brightest = 0.0f;
  forEachColour(meshes, [&](const vec4& c) { brightest = std::max({brightest, c.r, c.g, c.b}); });
  if (exposure)
    out.scale = std::exp2(*exposure);
  else if (brightest > 0.0f)
    out.scale = 1.0f / brightest;
  forEachColour(meshes, [&](vec4& c) {
    const vec3 colour = out.scale * vec3(c);
    out.clipped += exposure && glm::any(glm::greaterThan(colour, vec3(1.0f)));
    c = vec4(glm::min(colour, vec3(1.0f)), c.a);
  });
}

}  // namespace

std::optional<LitScene> withVertexColours(const Scene& scene, const VertexColourOptions& o,
                                          const BakeProgress& progress) {
  World world;
  world.update(scene, SceneChanges::all());
  const RenderScene& render = world.scene();
  const std::vector<NodeMesh> nodes = litNodes(scene, render);
  if (nodes.empty())
    throw InputError(o.name, "has no mesh that can be lit", "give a scene with meshes");
  const BakedLight light(render, *world.rays(), o.light);
  std::vector<std::unique_ptr<VertexLight>> lit;
  VertexLight::Sum sum;
  for (const NodeMesh& node : nodes) {
    const auto& mesh = *scene.meshes[static_cast<size_t>(scene.nodes[node.node].mesh)];
    lit.push_back(std::make_unique<VertexLight>(render, light, mesh, node));
    sum.light += lit.back()->sum().light;
    sum.count += lit.back()->sum().count;
  }
  const double mean = sum.light / static_cast<double>(std::max<size_t>(sum.count, 1));

  LitScene out{scene};
  LitMeshes meshes(out.scene);
  for (size_t i = 0; i < nodes.size(); ++i) {
    const int source = scene.nodes[nodes[i].node].mesh;
    lit[i]->refine(o.vertices, static_cast<float>(mean));
    std::shared_ptr<Mesh> mesh = lit[i]->litMesh();
    lit[i].reset();
    out.trianglesBefore += trianglesOf(*scene.meshes[static_cast<size_t>(source)]);
    out.triangles += trianglesOf(*mesh);
    meshes.add(nodes[i].node, std::move(mesh));
    if (progress && !progress(static_cast<int>(i) + 1, static_cast<int>(nodes.size())) &&
        i + 1 < nodes.size())
      return std::nullopt;
  }
  out.meshes = meshes.all().size();
  scaleColours(meshes.all(), o.exposure, out);
  return out;
}

std::vector<std::filesystem::path> writeLitScene(const LitScene& lit,
                                                 const VertexColourOptions& o) {
  const std::filesystem::path copy = o.output / (o.name + ".gltf");
  const std::filesystem::path note = o.output / (o.name + "-light.json");
  nlohmann::ordered_json j;
  j["scene"] = copy.filename().string();
  j["attribute"] = "COLOR_0";
  j["quantity"] =
      "irradiance / pi, W/(m2 sr), linear Rec. 709, times the vertex colour before, times scale; "
      "reflected radiance is base colour times it / scale";
  j["scale"] = lit.scale;
  const std::string text = j.dump(2) + "\n";
  PendingFile pending(note, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  std::vector<std::filesystem::path> files = saveGltf(lit.scene, copy);
  pending.putInPlace();
  files.push_back(note);
  return files;
}

}  // namespace lamplighter
