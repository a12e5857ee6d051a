#include "tests/support/scenes/scene_equality.h"

#include <map>

namespace lamplighter::test {

namespace {

// Nodes in depth-first order with siblings in their order, so that nodes are compared by position
// and not by id.
struct Placed {
  const Node* node;
  size_t depth;
};

std::vector<Placed> depthFirst(const Scene& scene) {
  std::map<NodeId, std::vector<const Node*>> children;
  for (const Node& node : scene.nodes) {
    children[scene.find(node.parent) == nullptr ? kNoNode : node.parent].push_back(&node);
  }
  std::vector<Placed> out, open;
  const auto push = [&](NodeId parent, size_t depth) {
    const auto& list = children[parent];
    for (auto it = list.rbegin(); it != list.rend(); ++it) open.push_back({*it, depth});
  };
  push(kNoNode, 0);
  while (!open.empty()) {
    const Placed next = open.back();
    open.pop_back();
    out.push_back(next);
    push(next.node->id, next.depth + 1);
  }
  return out;
}

std::string differs(const char* what, size_t index) {
  return std::string(what) + " " + std::to_string(index);
}

bool same(const Primitive& p, const Primitive& q) {
  return p.positions == q.positions && p.normals == q.normals && p.tangents == q.tangents &&
         p.uv0 == q.uv0 && p.uv1 == q.uv1 && p.colors == q.colors && p.indices == q.indices &&
         p.material == q.material;
}

}  // namespace

std::string difference(const Scene& a, const Scene& b) {
  if (a.name != b.name) return "name: " + a.name + " / " + b.name;
  if (a.nodes.size() != b.nodes.size()) {
    return "nodes: " + std::to_string(a.nodes.size()) + " / " + std::to_string(b.nodes.size());
  }
  const auto nodesA = depthFirst(a), nodesB = depthFirst(b);
  if (nodesA.size() != nodesB.size()) return "trees of nodes";
  for (size_t i = 0; i < nodesA.size(); ++i) {
    const Node &m = *nodesA[i].node, &n = *nodesB[i].node;
    const std::string at = " of node " + std::to_string(i) + " (" + m.name + " / " + n.name + ")";
    if (m.name != n.name) return "name" + at;
    if (nodesA[i].depth != nodesB[i].depth) return "depth" + at;
    if (!(m.local == n.local)) return "transform" + at;
    if (m.mesh != n.mesh) return "mesh" + at;
    if (m.camera != n.camera) return "camera" + at;
    if (m.punctual != n.punctual) return "punctual light" + at;
    if (m.area != n.area) return "area light" + at;
    if (m.visible != n.visible) return "visibility" + at;
    if (m.locked != n.locked) return "lock" + at;
    if (m.light != n.light) return "state of the light" + at;
  }
  if (a.meshes.size() != b.meshes.size()) return "count of meshes";
  for (size_t i = 0; i < a.meshes.size(); ++i) {
    const Mesh &m = *a.meshes[i], &n = *b.meshes[i];
    if (m.name != n.name) return differs("name of mesh", i);
    if (m.primitives.size() != n.primitives.size()) return differs("primitives of mesh", i);
    for (size_t p = 0; p < m.primitives.size(); ++p) {
      if (!same(m.primitives[p], n.primitives[p])) return differs("data of mesh", i);
    }
  }
  if (a.materials.size() != b.materials.size()) return "count of materials";
  for (size_t i = 0; i < a.materials.size(); ++i) {
    if (!(a.materials[i] == b.materials[i])) return differs("material", i);
  }
  if (!(a.cameras == b.cameras)) return "cameras";
  if (a.textures.size() != b.textures.size()) return "count of textures";
  for (size_t i = 0; i < a.textures.size(); ++i) {
    const Texture &s = a.textures[i], &t = b.textures[i];
    if (s.name != t.name || s.wrapS != t.wrapS || s.wrapT != t.wrapT || s.nearest != t.nearest ||
        s.image->width != t.image->width || s.image->height != t.image->height ||
        s.image->pixels != t.image->pixels) {
      return differs("texture", i);
    }
  }
  if (a.sky != b.sky || a.skyIsDefault != b.skyIsDefault) return "sky";
  if (a.skyLight != b.skyLight) return "state of the sky";
  if (a.lightGroups != b.lightGroups) return "groups of lights";
  return "";
}

}  // namespace lamplighter::test
