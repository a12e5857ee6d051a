#include "editor/recovery/document_delta.h"

#include <algorithm>
#include <type_traits>
#include <unordered_map>

namespace lamplighter {

namespace {

template <typename T>
Json listOf(const std::vector<T>& values, Blobs& blobs) {
  Json out = Json::array();
  for (const T& v : values) out.push_back(toJson(v, blobs));
  return out;
}

template <typename T>
std::vector<T> valuesOf(const Json& list, Blobs& blobs) {
  std::vector<T> out(list.size());
  for (size_t i = 0; i < out.size(); ++i) fromJson(list.at(i), blobs, out[i]);
  return out;
}

// Stores the indices of the items that are in `base`, and the other items in full.
template <typename T, typename Write>
Json assets(const std::vector<T>& base, const std::vector<T>& values, Write write) {
  Json out = Json::array();
  for (size_t i = 0; i < values.size(); ++i) {
    if (i < base.size() && base[i] == values[i]) {
      out.push_back(i);
      continue;
    }
    const auto it = std::find(base.begin(), base.end(), values[i]);
    if (it != base.end())
      out.push_back(it - base.begin());
    else
      out.push_back(write(values[i]));
  }
  return out;
}

template <typename T, typename Read>
std::vector<T> assetsOf(const std::vector<T>& base, const Json& list, Read read) {
  std::vector<T> out;
  for (const Json& entry : list) {
    if (!entry.is_number()) {
      out.push_back(read(entry));
      continue;
    }
    const auto index = wholeOf<size_t>(entry);
    if (index >= base.size()) damagedJournal("the level has different meshes or textures");
    out.push_back(base[index]);
  }
  return out;
}

template <typename T>
Json meshesOrTextures(const std::vector<T>& base, const std::vector<T>& values, Blobs& blobs) {
  return assets(base, values, [&](const T& value) {
    if constexpr (std::is_same_v<T, Texture>)
      return toJson(value, blobs);
    else
      return toJson(*value, blobs);
  });
}

Json nodesDelta(const DocumentChange& change, Blobs& blobs) {
  Json set = Json::array(), gone = Json::array();
  std::vector<NodeId> added;
  for (const auto& [id, node] : change.nodes) {
    if (!node.before) added.push_back(id);
    if (node.after)
      set.push_back(toJson(*node.after, blobs));
    else
      gone.push_back(id);
  }
  Json out = Json::object();
  if (change.order.after) {
    // What applyNodes() gives without an order: new nodes at the end.
    std::vector<NodeId> expected = *change.order.before;
    std::erase_if(expected, [&](NodeId id) {
      const auto node = change.nodes.find(id);
      return node != change.nodes.end() && !node->second.after;
    });
    expected.insert(expected.end(), added.begin(), added.end());
    if (expected != *change.order.after) out["order"] = *change.order.after;
  }
  if (!set.empty()) out["set"] = std::move(set);
  if (!gone.empty()) out["gone"] = std::move(gone);
  return out;
}

void applyNodes(std::vector<Node>& nodes, const Json& delta, Blobs& blobs) {
  std::unordered_map<NodeId, size_t> place;
  if (delta.contains("gone")) {
    std::unordered_map<NodeId, bool> gone;
    for (const Json& id : delta["gone"]) gone[wholeOf<NodeId>(id)] = true;
    std::erase_if(nodes, [&](const Node& n) { return gone.contains(n.id); });
  }
  for (size_t i = 0; i < nodes.size(); ++i) place[nodes[i].id] = i;
  if (delta.contains("set")) {
    for (const Json& json : delta["set"]) {
      Node n;
      fromJson(json, blobs, n);
      if (const auto it = place.find(n.id); it != place.end()) {
        nodes[it->second] = std::move(n);
      } else {
        place[n.id] = nodes.size();
        nodes.push_back(std::move(n));
      }
    }
  }
  if (!delta.contains("order")) return;
  std::vector<Node> ordered;
  for (const Json& id : delta["order"]) {
    const auto it = place.find(wholeOf<NodeId>(id));
    if (it == place.end()) damagedJournal("an object is missing");
    ordered.push_back(std::move(nodes[it->second]));
    place.erase(it);
  }
  nodes = std::move(ordered);
}

// Checks the invariants that the rest of the program assumes of a scene.
void checkIndices(const Scene& s) {
  const auto within = [](int i, size_t n) { return i == kNone || (i >= 0 && size_t(i) < n); };
  std::unordered_map<NodeId, bool> before;
  for (const Node& n : s.nodes) {
    const bool fits = within(n.mesh, s.meshes.size()) && within(n.camera, s.cameras.size()) &&
                      (n.parent == kNoNode || before.contains(n.parent)) && n.id != kNoNode &&
                      n.id < s.nextId && !before.contains(n.id);
    if (!fits) damagedJournal("an object refers to something that does not exist");
    before[n.id] = true;
  }
  for (const auto& mesh : s.meshes)
    for (const Primitive& p : mesh->primitives)
      if (!within(p.material, s.materials.size())) damagedJournal("a mesh has no material");
  for (const Material& m : s.materials)
    for (const TextureRef* r :
         {&m.baseColorTexture, &m.normalTexture, &m.emissiveTexture, &m.metallicRoughnessTexture})
      if (!within(r->texture, s.textures.size())) damagedJournal("a material has no texture");
}

}  // namespace

Json wholeDocument(const Scene& base, const Document& document, Blobs& blobs) {
  // Structured bindings: a new member does not compile until it is handled here.
  const auto& [name, nodes, meshes, materials, textures, cameras, nextId, sky, skyLight,
               lightGroups, bookmarks, skyIsDefault, source] = document.scene;
  return {{"allNodes", listOf(nodes, blobs)},
          {"meshes", meshesOrTextures(base.meshes, meshes, blobs)},
          {"textures", meshesOrTextures(base.textures, textures, blobs)},
          {"allMaterials", listOf(materials, blobs)},
          {"cameras", listOf(cameras, blobs)},
          {"name", name},
          {"nextId", nextId},
          {"sky", toJson(sky, blobs)},
          {"skyIsDefault", skyIsDefault},
          {"skyLight", toJson(skyLight, blobs)},
          {"lightGroups", listOf(lightGroups, blobs)},
          {"bookmarks", listOf(bookmarks, blobs)},
          {"render", toJson(document.render, blobs)}};
}

Json deltaOf(const Scene& base, const DocumentChange& change, const Document& after, Blobs& blobs) {
  const auto& [nodes, order, meshes, materials, textures, sky, skyIsDefault, skyLight, lightGroups,
               bookmarks, render] = change;
  const Scene& scene = after.scene;
  Json out = Json::object();
  out["nextId"] = scene.nextId;
  if (Json delta = nodesDelta(change, blobs); !delta.empty()) out["nodes"] = std::move(delta);
  if (!meshes.empty()) out["meshes"] = meshesOrTextures(base.meshes, scene.meshes, blobs);
  if (!textures.empty()) out["textures"] = meshesOrTextures(base.textures, scene.textures, blobs);
  if (!materials.empty()) {
    Json changed = Json::array();
    for (const auto& [index, material] : materials)
      if (material.after) changed.push_back({index, toJson(*material.after, blobs)});
    out["materials"] = {{"count", scene.materials.size()}, {"set", std::move(changed)}};
  }
  if (sky.after || skyIsDefault.after) {
    out["sky"] = toJson(scene.sky, blobs);
    out["skyIsDefault"] = scene.skyIsDefault;
  }
  if (skyLight.after) out["skyLight"] = toJson(*skyLight.after, blobs);
  if (lightGroups.after) out["lightGroups"] = listOf(*lightGroups.after, blobs);
  if (bookmarks.after) out["bookmarks"] = listOf(*bookmarks.after, blobs);
  if (render.after) out["render"] = toJson(*render.after, blobs);
  return out;
}

void applyDelta(const Scene& base, Document& document, const Json& delta, Blobs& blobs) {
  if (!delta.is_object()) damagedJournal("a line is not an object");
  Scene scene = document.scene;
  RenderSettings render = document.render;
  const auto has = [&](const char* key) { return delta.contains(key); };
  if (has("allNodes")) scene.nodes = valuesOf<Node>(delta["allNodes"], blobs);
  if (has("nodes")) applyNodes(scene.nodes, delta["nodes"], blobs);
  if (has("meshes")) {
    scene.meshes = assetsOf(base.meshes, delta["meshes"], [&](const Json& j) {
      auto mesh = std::make_shared<Mesh>();
      fromJson(j, blobs, *mesh);
      return std::shared_ptr<const Mesh>(std::move(mesh));
    });
  }
  if (has("textures")) {
    scene.textures = assetsOf(base.textures, delta["textures"], [&](const Json& j) {
      Texture texture;
      fromJson(j, blobs, texture);
      return texture;
    });
  }
  if (has("allMaterials")) scene.materials = valuesOf<Material>(delta["allMaterials"], blobs);
  if (has("materials")) {
    const Json& materials = delta["materials"];
    const Json& set = materials.at("set");
    const size_t count = wholeOf<size_t>(materials.at("count"));
    if (count > scene.materials.size() + set.size()) damagedJournal("materials are missing");
    scene.materials.resize(count);
    for (const Json& entry : set)
      fromJson(entry.at(1), blobs, scene.materials.at(wholeOf<size_t>(entry.at(0))));
  }
  if (has("cameras")) scene.cameras = valuesOf<Camera>(delta["cameras"], blobs);
  if (has("name")) scene.name = delta["name"].get<std::string>();
  if (has("nextId")) scene.nextId = wholeOf<NodeId>(delta["nextId"]);
  if (has("sky")) {
    fromJson(delta["sky"], blobs, scene.sky);
    scene.skyIsDefault = delta.at("skyIsDefault").get<bool>();
  }
  if (has("skyLight")) fromJson(delta["skyLight"], blobs, scene.skyLight);
  if (has("lightGroups")) scene.lightGroups = valuesOf<LightGroup>(delta["lightGroups"], blobs);
  if (has("bookmarks")) scene.bookmarks = valuesOf<CameraBookmark>(delta["bookmarks"], blobs);
  if (has("render")) fromJson(delta["render"], blobs, render);
  checkIndices(scene);
  document.scene = std::move(scene);
  document.render = std::move(render);
}

}  // namespace lamplighter
