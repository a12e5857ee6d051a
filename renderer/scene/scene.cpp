#include "renderer/scene/scene.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_picture.h"

namespace lamplighter {

const Node* Scene::find(NodeId id) const {
  if (id == kNoNode) return nullptr;
  // New nodes get larger ids and are appended, so ids are mostly ascending: binary search first. If
  // that fails because nodes were reordered, all nodes are searched.
  size_t first = 0, last = nodes.size();
  while (first < last) {
    const size_t middle = first + (last - first) / 2;
    if (nodes[middle].id == id) return &nodes[middle];
    (nodes[middle].id < id ? first : last) = nodes[middle].id < id ? middle + 1 : middle;
  }
  const auto it =
      std::find_if(nodes.begin(), nodes.end(), [&](const Node& n) { return n.id == id; });
  return it == nodes.end() ? nullptr : &*it;
}

Node* Scene::find(NodeId id) { return const_cast<Node*>(std::as_const(*this).find(id)); }

mat4 worldMatrix(const Scene& scene, NodeId id) {
  mat4 m(1.0f);
  for (const Node* n = scene.find(id); n != nullptr; n = scene.find(n->parent)) {
    m = toMatrix(n->local) * m;
    if (n->parent == kNoNode) break;
  }
  return m;
}

namespace {

// Calls visit(node index, parent's index or kNone) for all nodes, parents first.
template <typename Visit>
void forEachWithParent(const Scene& scene, Visit visit) {
  std::unordered_map<NodeId, int> indexOf;
  indexOf.reserve(scene.nodes.size());
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const auto parent = indexOf.find(scene.nodes[i].parent);
    visit(i, parent == indexOf.end() ? kNone : parent->second);
    indexOf[scene.nodes[i].id] = static_cast<int>(i);
  }
}

}  // namespace

std::vector<mat4> worldMatrices(const Scene& scene) {
  std::vector<mat4> world(scene.nodes.size());
  forEachWithParent(scene, [&](size_t i, int parent) {
    const mat4 local = toMatrix(scene.nodes[i].local);
    world[i] = parent == kNone ? local : world[parent] * local;
  });
  return world;
}

std::vector<bool> visibleNodes(const Scene& scene) {
  std::vector<bool> visible(scene.nodes.size());
  forEachWithParent(scene, [&](size_t i, int parent) {
    visible[i] = scene.nodes[i].visible && (parent == kNone || visible[parent]);
  });
  return visible;
}

bool PunctualLight::operator==(const PunctualLight& o) const {
  return kind == o.kind && intensity == o.intensity && range == o.range &&
         innerCone == o.innerCone && outerCone == o.outerCone &&
         (profile == o.profile || (profile && o.profile && *profile == *o.profile));
}

bool AreaLight::operator==(const AreaLight& o) const {
  return shape == o.shape && radiance == o.radiance && size == o.size &&
         (picture == o.picture || (picture && o.picture && *picture == *o.picture));
}

bool emitsLight(const Scene& scene, const Node& n) {
  if (n.area || n.punctual) return true;
  if (n.mesh == kNone) return false;
  const auto& primitives = scene.meshes[n.mesh]->primitives;
  return std::any_of(primitives.begin(), primitives.end(), [&](const Primitive& p) {
    return p.material != kNone && scene.materials[p.material].emits();
  });
}

bool hasLight(const Scene& scene) {
  return std::any_of(scene.nodes.begin(), scene.nodes.end(),
                     [&](const Node& n) { return emitsLight(scene, n); });
}

}  // namespace lamplighter
