#include "renderer/bake/node_meshes.h"

namespace lamplighter {

std::vector<NodeMesh> nodeMeshes(const Scene& scene, const RenderScene& render) {
  std::vector<NodeMesh> out;
  uint32_t object = 0;
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const Node& node = scene.nodes[n];
    NodeMesh mesh{n, {}};
    size_t primitive = 0;
    for (; object < render.objects.size() && render.objects[object].node == node.id; ++object) {
      if (render.objects[object].isAreaLight) continue;
      const Mesh& of = *scene.meshes[static_cast<size_t>(node.mesh)];
      while (of.primitives[primitive].indices.empty()) ++primitive;
      mesh.parts.push_back({primitive++, object});
    }
    if (!mesh.parts.empty()) out.push_back(std::move(mesh));
  }
  return out;
}

int MeshReplacement::replace(size_t node, std::shared_ptr<const Mesh> mesh) {
  int& index = scene_.nodes[node].mesh;
  if (replaced_.insert(index).second) {
    scene_.meshes[static_cast<size_t>(index)] = std::move(mesh);
  } else {
    index = static_cast<int>(scene_.meshes.size());
    scene_.meshes.push_back(std::move(mesh));
  }
  return index;
}

}  // namespace lamplighter
