// The meshes of nodes and their objects, to give each node a mesh of its own.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

struct NodeMesh {
  struct Part {
    size_t primitive = 0;  // of the mesh
    uint32_t object = 0;   // index into RenderScene::objects
  };
  size_t node = 0;          // index into Scene::nodes
  std::vector<Part> parts;  // visible parts; at least one
};
// All nodes with a visible mesh. `render` must be made from `scene`.
std::vector<NodeMesh> nodeMeshes(const Scene& scene, const RenderScene& render);

// Replaces meshes of a copy of a scene. The first node of a mesh that gets another one takes its
// place in the list; those of other nodes are appended.
class MeshReplacement {
 public:
  explicit MeshReplacement(Scene& copy) : scene_(copy) {}
  // Returns the index of the mesh. `node`: index into Scene::nodes.
  int replace(size_t node, std::shared_ptr<const Mesh> mesh);

 private:
  Scene& scene_;
  std::set<int> replaced_;
};

}  // namespace lamplighter
