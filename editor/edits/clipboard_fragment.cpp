#include "editor/edits/clipboard_fragment.h"

#include <algorithm>
#include <unordered_set>

namespace lamplighter {

namespace {

// Calls f for each reference of a material to a texture.
template <typename F>
void eachTexture(Material& m, F f) {
  for (TextureRef* ref :
       {&m.baseColorTexture, &m.normalTexture, &m.emissiveTexture, &m.metallicRoughnessTexture})
    if (ref->texture != kNone) f(ref->texture);
}

// What was read from two files can be the same.
bool isLike(const Material& a, const Material& b) { return a == b; }

bool isLike(const Texture& a, const Texture& b) {
  if (a == b) return true;
  const Image8 &p = *a.image, &q = *b.image;
  if (p.width != q.width || p.height != q.height || p.pixels != q.pixels) return false;
  Texture other = b;
  other.image = a.image;
  other.name = a.name;
  return a == other;
}

bool isLike(const Primitive& p, const Primitive& q) {
  return p.material == q.material && p.positions == q.positions && p.indices == q.indices &&
         p.normals == q.normals && p.tangents == q.tangents && p.uv0 == q.uv0 && p.uv1 == q.uv1 &&
         p.colors == q.colors;
}

bool isLike(const std::shared_ptr<const Mesh>& a, const std::shared_ptr<const Mesh>& b) {
  return a == b || (a->name == b->name &&
                    std::equal(a->primitives.begin(), a->primitives.end(), b->primitives.begin(),
                               b->primitives.end(), [](const Primitive& p, const Primitive& q) {
                                 return isLike(p, q);
                               }));
}

// Finds its like in a list of the scene's and of what is added to it, or adds it.
template <typename T>
int indexOf(const T& value, const std::vector<T>& present, std::vector<T>& added) {
  const auto isIt = [&](const T& other) { return isLike(value, other); };
  if (const auto it = std::find_if(present.begin(), present.end(), isIt); it != present.end())
    return static_cast<int>(it - present.begin());
  if (const auto it = std::find_if(added.begin(), added.end(), isIt); it != added.end())
    return static_cast<int>(present.size()) + static_cast<int>(it - added.begin());
  added.push_back(value);
  return static_cast<int>(present.size() + added.size()) - 1;
}

// What a copied light leaves out: copies too, and in the same level what it did.
std::vector<NodeId> leftOutOf(const LightState& light, const std::map<NodeId, NodeId>& newId,
                              bool isSameLevel) {
  std::vector<NodeId> out;
  for (const NodeId id : light.leftOut) {
    if (isSameLevel) out.push_back(id);
    if (const auto copy = newId.find(id); copy != newId.end()) out.push_back(copy->second);
  }
  std::sort(out.begin(), out.end());
  return out;
}

bool hasMaterials(const Mesh& mesh, const std::map<int, int>& newIndex) {
  return std::all_of(mesh.primitives.begin(), mesh.primitives.end(), [&](const Primitive& p) {
    return p.material == kNone || newIndex.at(p.material) == p.material;
  });
}

}  // namespace

ClipboardFragment clip(const Scene& scene, const std::vector<NodeId>& ids) {
  ClipboardFragment out;
  const std::unordered_set<NodeId> given(ids.begin(), ids.end());
  std::unordered_set<NodeId> taken;
  for (const Node& n : scene.nodes) {  // parents come first
    const bool isBelow = n.parent != kNoNode && taken.contains(n.parent);
    if (!isBelow && !given.contains(n.id)) continue;
    taken.insert(n.id);
    out.nodes.push_back(n);
    if (!isBelow) out.places[n.id] = decompose(worldMatrix(scene, n.id));
    if (n.mesh != kNone) out.meshes[n.mesh] = scene.meshes[static_cast<size_t>(n.mesh)];
  }
  for (const auto& [index, mesh] : out.meshes) {
    for (const Primitive& p : mesh->primitives)
      if (p.material != kNone)
        out.materials[p.material] = scene.materials[static_cast<size_t>(p.material)];
  }
  for (auto& [index, material] : out.materials)
    eachTexture(material, [&](int t) { out.textures[t] = scene.textures[static_cast<size_t>(t)]; });
  return out;
}

PastedNodes pasteInto(Editing& editing, const ClipboardFragment& fragment, bool isSameLevel) {
  const Scene& scene = editing.document().scene;
  PastedNodes out;
  std::map<int, int> textures, materials, meshes;
  for (const auto& [index, texture] : fragment.textures)
    textures[index] = indexOf(texture, scene.textures, out.textures);
  for (const auto& [index, material] : fragment.materials) {
    Material m = material;
    eachTexture(m, [&](int& t) { t = textures.at(t); });
    materials[index] = indexOf(m, scene.materials, out.materials);
  }
  for (const auto& [index, mesh] : fragment.meshes) {
    std::shared_ptr<const Mesh> here = mesh;
    if (!hasMaterials(*mesh, materials)) {
      auto changed = std::make_shared<Mesh>(*mesh);
      for (Primitive& p : changed->primitives)
        if (p.material != kNone) p.material = materials.at(p.material);
      here = std::move(changed);
    }
    meshes[index] = indexOf(here, scene.meshes, out.meshes);
  }

  std::map<NodeId, NodeId> newId;
  for (const Node& n : fragment.nodes) newId[n.id] = editing.newNodeId();
  for (Node n : fragment.nodes) {
    const NodeId was = n.id;
    n.id = newId.at(was);
    n.light.leftOut = leftOutOf(n.light, newId, isSameLevel);
    if (n.mesh != kNone) n.mesh = meshes.at(n.mesh);
    if (const auto parent = newId.find(n.parent); parent != newId.end()) {
      n.parent = parent->second;
    } else {
      out.roots.push_back(n.id);
      if (n.parent != kNoNode && (!isSameLevel || scene.find(n.parent) == nullptr)) {
        n.parent = kNoNode;
        n.local = fragment.places.at(was);
      }
    }
    if (!isSameLevel) {
      n.camera = kNone;  // the other level's list
      n.sourceNode = kNone;
    }
    out.nodes.push_back(std::move(n));
  }
  return out;
}

void add(Transaction& edit, PastedNodes pasted) {
  for (auto& mesh : pasted.meshes) edit.add(std::move(mesh));
  for (Material& material : pasted.materials) edit.add(std::move(material));
  for (Texture& texture : pasted.textures) edit.add(std::move(texture));
  edit.addNodes(std::move(pasted.nodes));
}

}  // namespace lamplighter
