// Saves the nodes of a scene. Nodes of the source keep their JSON, patched. Deleted nodes are
// removed, and all node indices in the file are updated.
#include <charconv>
#include <optional>
#include <unordered_map>

#include "renderer/scene/gltf/gltf_content.h"
#include "renderer/scene/gltf/save/gltf_output.h"

namespace lamplighter {

namespace {

constexpr size_t kGone = SIZE_MAX;

// New index of each entry of a list, or kGone.
using IndexMap = std::vector<size_t>;

void saveTransform(Json& json, const Transform& t) {
  for (const char* key : {"matrix", "translation", "rotation", "scale"}) json.erase(key);
  const Transform none;
  if (t.shear != none.shear) {
    const mat4 m = toMatrix(t);
    Json& matrix = json["matrix"] = Json::array();
    for (int i = 0; i < 16; ++i) matrix.push_back(toJson(m[i / 4][i % 4]));
    return;
  }
  if (t.translation != none.translation) json["translation"] = toJson(t.translation);
  if (t.rotation != none.rotation) {
    json["rotation"] = toJson(vec4(t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w));
  }
  if (t.scale != none.scale) json["scale"] = toJson(t.scale);
}

void saveIndex(Json& json, const char* key, int index) {
  if (index == kNone) {
    json.erase(key);
  } else {
    json[key] = index;
  }
}

// Saves everything except light, children and the mesh of a sphere light.
void saveNode(GltfOutput& out, Json& json, const Node& now, const Node& was) {
  if (now.name != was.name) json["name"] = now.name;
  if (!(now.local == was.local)) saveTransform(json, now.local);
  saveIndex(json, "mesh", now.mesh);
  if (now.mesh != was.mesh) {
    json.erase("skin");
    json.erase("weights");
  }
  saveIndex(json, "camera", now.camera);
  if (now.meshKind != was.meshKind) {
    eraseNote(json, kMeshKindNote);
    if (now.meshKind != MeshKind::automatic)
      noteFor(json)[kMeshKindNote] = now.meshKind == MeshKind::simple ? "simple" : "complex";
  }
  if (now.locked != was.locked) {
    eraseNote(json, kLockedNote);
    if (now.locked) noteFor(json)[kLockedNote] = true;
  }
  if (now.visible != was.visible) {
    eraseExtension(json, "KHR_node_visibility");
    if (!now.visible) {
      extensionObject(json, "KHR_node_visibility")["visible"] = false;
      out.useExtension("KHR_node_visibility");
    }
  }
}

void saveCameras(GltfOutput& out) {
  const size_t count = listOf(out.source.document, "cameras").size();
  for (size_t i = 0; i < out.scene.cameras.size(); ++i) {
    const Camera& now = out.scene.cameras[i];
    if (i < count && now == readCamera(out.source.document, i)) continue;
    if (i >= count) out.append("cameras", Json::object());
    Json& json = out.json["cameras"][i];
    json["type"] = "perspective";
    json.erase("orthographic");
    if (!now.name.empty()) json["name"] = now.name;
    Json& lens = json["perspective"];
    lens["yfov"] = toJson(now.yfov);
    lens["znear"] = toJson(now.znear);
    lens.erase("aspectRatio");
    lens.erase("zfar");
    if (now.aspect > 0.0f) lens["aspectRatio"] = toJson(now.aspect);
    if (now.zfar > 0.0f) lens["zfar"] = toJson(now.zfar);
  }
}

// Updates an array of node indices; removed nodes are dropped.
Json remapped(const Json& indices, const IndexMap& map) {
  Json out = Json::array();
  for (const Json& index : indices) {
    const size_t to = map[index.get<size_t>()];
    if (to != kGone) out.push_back(to);
  }
  return out;
}

// A skin that lost a joint is invalid, because its weights refer to joints by index. It is removed,
// and nodes that used it show their mesh undeformed.
void remapSkins(Json& root, const IndexMap& map) {
  const auto skins = root.find("skins");
  if (skins == root.end()) return;
  IndexMap skinMap;
  Json kept = Json::array();
  for (Json& skin : *skins) {
    const size_t joints = skin.contains("joints") ? skin["joints"].size() : 0;
    if (joints > 0) skin["joints"] = remapped(skin["joints"], map);
    if (joints > 0 && skin["joints"].size() < joints) {
      skinMap.push_back(kGone);
      continue;
    }
    if (skin.contains("skeleton")) {
      const size_t to = map[skin["skeleton"].get<size_t>()];
      if (to == kGone) {
        skin.erase("skeleton");
      } else {
        skin["skeleton"] = to;
      }
    }
    skinMap.push_back(kept.size());
    kept.push_back(skin);
  }
  for (Json& node : root["nodes"]) {
    if (!node.contains("skin")) continue;
    const size_t to = skinMap[node["skin"].get<size_t>()];
    if (to == kGone) {
      node.erase("skin");
    } else {
      node["skin"] = to;
    }
  }
  if (kept.empty()) {
    root.erase("skins");
  } else {
    *skins = std::move(kept);
  }
}

// KHR_animation_pointer refers to nodes by JSON pointers: "/nodes/7/…". Returns false if the node
// was removed.
bool remapPointer(Json& target, const IndexMap& map) {
  const Json* extension = extensionOf(target, "KHR_animation_pointer");
  const Json* pointer = extension == nullptr ? nullptr : member(*extension, "pointer");
  if (pointer == nullptr || !pointer->is_string()) return true;
  const std::string text = pointer->get<std::string>();
  constexpr std::string_view kNodes = "/nodes/";
  if (!text.starts_with(kNodes)) return true;
  size_t index = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + kNodes.size(), end, index);
  if (error != std::errc() || index >= map.size()) return true;
  if (map[index] == kGone) return false;
  target["extensions"]["KHR_animation_pointer"]["pointer"] =
      std::string(kNodes) + std::to_string(map[index]) + std::string(rest, end);
  return true;
}

void remapAnimations(Json& root, const IndexMap& map) {
  const auto animations = root.find("animations");
  if (animations == root.end()) return;
  Json kept = Json::array();
  for (Json& animation : *animations) {
    if (animation.contains("channels")) {
      Json channels = Json::array();
      for (Json& channel : animation["channels"]) {
        const auto target = channel.find("target");
        if (target != channel.end() && target->contains("node")) {
          const size_t to = map[(*target)["node"].get<size_t>()];
          if (to == kGone) continue;
          (*target)["node"] = to;
        }
        if (target != channel.end() && !remapPointer(*target, map)) continue;
        channels.push_back(channel);
      }
      if (channels.empty()) continue;  // glTF does not allow animations without channels
      animation["channels"] = std::move(channels);
    }
    kept.push_back(animation);
  }
  if (kept.empty()) {
    root.erase("animations");
  } else {
    *animations = std::move(kept);
  }
}

class NodeSaver {
 public:
  explicit NodeSaver(GltfOutput& out)
      : out_(out), nodes_(out.scene.nodes), old_(listOf(out.source.document, "nodes")) {}

  std::vector<size_t> run() {
    matchToSource();
    const std::vector<size_t> index = assignIndices();
    Json list = Json::array();
    for (size_t i = 0; i < old_.size(); ++i) {
      if (map_[i] != kGone) list.push_back(out_.json["nodes"][i]);
    }
    for (size_t i = 0; i < nodes_.size(); ++i) {
      Json json = Json::object();
      Node was;
      if (from_[i]) {
        json = old_[*from_[i]];
        was = *loaded_[*from_[i]];
      }
      if (isNew_[i]) list.push_back(Json::object());
      saveNode(out_, json, nodes_[i], was);
      list[index[i]] = std::move(json);
    }
    out_.json["nodes"] = std::move(list);
    remapSkins(out_.json, map_);
    remapAnimations(out_.json, map_);
    saveTree(index);
    if (out_.json["nodes"].empty()) out_.json.erase("nodes");
    return index;
  }

 private:
  // Selects the source JSON of each node. A copy uses that of its original, so that unknown data is
  // copied too; the first node with the same source keeps its index.
  void matchToSource() {
    loaded_.assign(old_.size(), nullptr);
    for (const Node& node : out_.source.nodes) {
      loaded_[static_cast<size_t>(node.sourceNode)] = &node;
    }
    std::vector<bool> claimed(old_.size(), false);
    for (const Node& node : nodes_) {
      const bool known = node.sourceNode >= 0 &&
                         static_cast<size_t>(node.sourceNode) < old_.size() &&
                         loaded_[static_cast<size_t>(node.sourceNode)] != nullptr;
      from_.push_back(known ? std::optional(static_cast<size_t>(node.sourceNode)) : std::nullopt);
      isNew_.push_back(!known || claimed[*from_.back()]);
      if (known) claimed[*from_.back()] = true;
    }
    size_t next = 0;
    for (size_t i = 0; i < old_.size(); ++i) {
      const bool deleted = loaded_[i] != nullptr && !claimed[i];
      map_.push_back(deleted ? kGone : next++);
    }
    firstNew_ = next;
  }

  std::vector<size_t> assignIndices() const {
    std::vector<size_t> index;
    size_t next = firstNew_;
    for (size_t i = 0; i < nodes_.size(); ++i) {
      index.push_back(isNew_[i] ? next++ : map_[*from_[i]]);
    }
    return index;
  }

  // Writes children and roots in the order of the scene. Nodes of other scenes in the file keep
  // theirs.
  void saveTree(const std::vector<size_t>& index) {
    Json& list = out_.json["nodes"];
    for (size_t i = 0; i < old_.size(); ++i) {
      if (loaded_[i] != nullptr || !old_[i].contains("children")) continue;
      list[map_[i]]["children"] = remapped(old_[i]["children"], map_);
    }
    std::unordered_map<NodeId, size_t> place;
    std::vector<Json> children(nodes_.size(), Json::array());
    Json roots = Json::array();
    std::vector<bool> isChild(list.size(), false);
    for (size_t i = 0; i < nodes_.size(); ++i) {
      const auto parent = place.find(nodes_[i].parent);
      if (parent == place.end()) {
        roots.push_back(index[i]);
      } else {
        children[parent->second].push_back(index[i]);
        isChild[index[i]] = true;
      }
      place[nodes_[i].id] = i;
    }
    for (size_t i = 0; i < nodes_.size(); ++i) {
      Json& json = list[index[i]];
      if (children[i].empty()) {
        json.erase("children");
      } else {
        json["children"] = std::move(children[i]);
      }
    }
    saveScenes(std::move(roots), isChild);
  }

  void saveScenes(Json roots, const std::vector<bool>& isChild) {
    if (!out_.json.contains("scenes")) {
      if (roots.empty()) return;
      out_.json["scenes"] = Json::array({Json::object()});
      out_.json["scene"] = 0;
    }
    Json& scenes = out_.json["scenes"];
    const size_t shown = out_.json.value("scene", size_t{0});
    for (size_t s = 0; s < scenes.size(); ++s) {
      Json nodes = Json::array();
      if (s == shown) {
        nodes = std::move(roots);
      } else if (scenes[s].contains("nodes")) {
        // A root of this other scene may have become a child of a saved node.
        for (const Json& root : remapped(scenes[s]["nodes"], map_)) {
          if (!isChild[root.get<size_t>()]) nodes.push_back(root);
        }
      }
      if (nodes.empty()) {
        scenes[s].erase("nodes");
      } else {
        scenes[s]["nodes"] = std::move(nodes);
      }
    }
    if (out_.scene.name != sceneName(out_.source.document)) {
      scenes[shown]["name"] = out_.scene.name;
    }
  }

  GltfOutput& out_;
  const std::vector<Node>& nodes_;
  const Json& old_;                          // the source's nodes
  std::vector<const Node*> loaded_;          // by source node: the present node; null: in another
                                             // scene
  std::vector<std::optional<size_t>> from_;  // by node: index of its JSON in old_
  std::vector<bool> isNew_;                  // by node: does not replace that source node
  IndexMap map_;                             // from old_ to the saved list
  size_t firstNew_ = 0;
};

}  // namespace

std::vector<size_t> saveNodes(GltfOutput& out) {
  saveCameras(out);
  return NodeSaver(out).run();
}

}  // namespace lamplighter
