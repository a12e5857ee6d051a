#include "editor/recovery/document_delta.h"

#include <algorithm>
#include <unordered_map>

#include "renderer/base/error.h"

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
    if (index >= base.size()) damagedJournal("the level has other meshes or textures");
    out.push_back(base[index]);
  }
  return out;
}

Json nodesDelta(const std::vector<Node>& from, const std::vector<Node>& to, Blobs& blobs) {
  std::unordered_map<NodeId, const Node*> was;
  for (const Node& n : from) was[n.id] = &n;
  Json set = Json::array(), order = Json::array(), gone = Json::array();
  std::unordered_map<NodeId, bool> stays;
  for (const Node& n : to) {
    stays[n.id] = true;
    const auto it = was.find(n.id);
    if (it == was.end() || !(*it->second == n)) set.push_back(toJson(n, blobs));
    order.push_back(n.id);
  }
  std::vector<NodeId> expected;  // the order after deletions, with new nodes at the end
  for (const Node& n : from)
    if (stays.contains(n.id))
      expected.push_back(n.id);
    else
      gone.push_back(n.id);
  for (const Node& n : to)
    if (!was.contains(n.id)) expected.push_back(n.id);
  const bool isExpected = std::equal(to.begin(), to.end(), expected.begin(), expected.end(),
                                     [](const Node& n, NodeId id) { return n.id == id; });
  Json out = Json::object();
  if (!set.empty()) out["set"] = std::move(set);
  if (!gone.empty()) out["gone"] = std::move(gone);
  if (!isExpected) out["order"] = std::move(order);
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
    if (!fits) damagedJournal("an object refers to what is not there");
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

Json deltaBetween(const Scene& base, const Document& before, const Document& after, Blobs& blobs,
                  bool whole) {
  // Structured bindings: a new member does not compile until it is handled here.
  const auto& [name, nodes, meshes, materials, textures, cameras, nextId, sky, skyLight,
               lightGroups, bookmarks, skyIsDefault, source] = after.scene;
  const Scene& was = before.scene;
  Json out = Json::object();
  if (whole)
    out["allNodes"] = listOf(nodes, blobs);
  else if (Json delta = nodesDelta(was.nodes, nodes, blobs); !delta.empty())
    out["nodes"] = std::move(delta);
  if (whole || meshes != was.meshes)
    out["meshes"] = assets(base.meshes, meshes, [&](const auto& m) { return toJson(*m, blobs); });
  if (whole || textures != was.textures)
    out["textures"] =
        assets(base.textures, textures, [&](const Texture& t) { return toJson(t, blobs); });
  if (whole) {
    out["allMaterials"] = listOf(materials, blobs);
  } else if (materials != was.materials) {
    Json changed = Json::array();
    for (size_t i = 0; i < materials.size(); ++i)
      if (i >= was.materials.size() || !(was.materials[i] == materials[i]))
        changed.push_back({i, toJson(materials[i], blobs)});
    out["materials"] = {{"count", materials.size()}, {"set", std::move(changed)}};
  }
  if (whole || cameras != was.cameras) out["cameras"] = listOf(cameras, blobs);
  if (whole || name != was.name) out["name"] = name;
  if (whole || nextId != was.nextId) out["nextId"] = nextId;
  if (whole || !(sky == was.sky) || skyIsDefault != was.skyIsDefault) {
    out["sky"] = toJson(sky, blobs);
    out["skyIsDefault"] = skyIsDefault;
  }
  if (whole || !(skyLight == was.skyLight)) out["skyLight"] = toJson(skyLight, blobs);
  if (whole || lightGroups != was.lightGroups) out["lightGroups"] = listOf(lightGroups, blobs);
  if (whole || bookmarks != was.bookmarks) out["bookmarks"] = listOf(bookmarks, blobs);
  if (whole || !(after.render == before.render)) out["render"] = toJson(after.render, blobs);
  return out;
}

void applyDelta(const Scene& base, Document& document, const Json& delta, Blobs& blobs) {
  if (!delta.is_object()) damagedJournal("a line is no object");
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
