// What glTF has no place for about lights: extras.lamplighter.light of a node (on, solo, group,
// what it leaves out, and the file of its profile or picture) and extras.lamplighter.lights of the
// scene (groups, the sky's state).
#include <algorithm>
#include <map>

#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_content.h"
#include "renderer/scene/gltf/save/gltf_output.h"
#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_picture.h"

namespace lamplighter {

namespace {

constexpr const char* kNodeNote = "light";
constexpr const char* kSceneNote = "lights";
constexpr const char* kProfile = "profile";
constexpr const char* kPicture = "picture";
constexpr const char* kLeavesOut = "leaves_out";  // indices of nodes
constexpr size_t kMostGroups = 10'000;

// The node of each node of the file, or none where it is not shown.
using NodeOfJson = std::vector<NodeId>;

NodeOfJson nodesOfJson(const GltfDocument& document, const std::vector<Node>& nodes) {
  NodeOfJson ids(listOf(document, "nodes").size(), kNoNode);
  for (const Node& n : nodes) ids[static_cast<size_t>(n.sourceNode)] = n.id;
  return ids;
}

LightState readState(const Json& note, const NodeOfJson& ids) {
  LightState state;
  if (const Json* list = member(note, kLeavesOut)) {
    for (const Json& i : *list)
      if (const NodeId id = ids[i.get<size_t>()]; id != kNoNode) state.leftOut.push_back(id);
  }
  std::vector<NodeId>& out = state.leftOut;
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  state.on = flagIn(note, "on", true);
  state.solo = flagIn(note, "solo", false);
  state.group = textIn(note, "group");
  return state;
}

Json stateJson(const LightState& state, const JsonOfNode& jsonNodes) {
  Json json = Json::object();
  for (const NodeId id : state.leftOut)
    if (const auto it = jsonNodes.find(id); it != jsonNodes.end())
      json[kLeavesOut].push_back(it->second);
  if (!state.on) json["on"] = false;
  if (state.solo) json["solo"] = true;
  if (!state.group.empty()) json["group"] = state.group;
  return json;
}

// One that cannot be had is left out with a warning: the light is a plain one then.
std::shared_ptr<const IesProfile> readProfile(GltfDocument& document, const std::string& uri) {
  std::string why;
  const Bytes bytes = readUri(document, uri, why);
  if (bytes == nullptr) {
    document.warn("a light's profile \"" + printable(uri) + "\" " + why +
                  "; the light shines without it");
    return nullptr;
  }
  const std::string name = std::filesystem::path(percentDecoded(uri)).filename().string();
  try {
    return parseIes({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, name);
  } catch (const InputError& e) {
    document.warn(std::string(e.what()) + "; the light shines without it");
    return nullptr;
  }
}

std::shared_ptr<const LightPicture> readPicture(GltfDocument& document, const std::string& uri) {
  std::string why;
  const Bytes bytes = readUri(document, uri, why);
  const std::string name = std::filesystem::path(percentDecoded(uri)).filename().string();
  auto picture = bytes == nullptr ? nullptr : decodeLightPicture(bytes, name, why);
  if (picture == nullptr)
    document.warn("a light's picture \"" + printable(uri) + "\" " + why +
                  "; the light shines without it");
  return picture;
}

// Whether the files that the scene names now are unchanged; `same` compares two existing ones.
template <typename T>
bool isSameFile(const std::shared_ptr<const T>& now, const std::shared_ptr<const T>& was) {
  return now == was || (now && was && *now == *was);
}

}  // namespace

std::shared_ptr<const LightPicture> readLightPicture(const std::filesystem::path& path) {
  std::string why;
  const Bytes bytes = readWholeFile(path, why);
  auto picture =
      bytes == nullptr ? nullptr : decodeLightPicture(bytes, path.filename().string(), why);
  if (picture == nullptr) throw InputError(path.string(), why, "name a PNG or JPEG file");
  return picture;
}

void readLightNotes(GltfDocument& document, std::vector<Node>& nodes) {
  std::map<std::string, std::shared_ptr<const IesProfile>> profiles;
  std::map<std::string, std::shared_ptr<const LightPicture>> pictures;
  const NodeOfJson ids = nodesOfJson(document, nodes);
  for (Node& node : nodes) {
    const auto index = static_cast<size_t>(node.sourceNode);
    const Json* note = noteOf(listOf(document, "nodes")[index], kNodeNote);
    if (note == nullptr || !note->is_object()) continue;
    node.light = readState(*note, ids);
    const std::string picture = textIn(*note, kPicture);
    if (!picture.empty() && node.area) {
      const auto [it, isNew] = pictures.try_emplace(picture);
      if (isNew) it->second = readPicture(document, picture);
      node.area->picture = it->second;
    }
    const std::string uri = textIn(*note, kProfile);
    if (uri.empty() || !node.punctual || node.punctual->kind == PunctualKind::directional) continue;
    const auto [it, isNew] = profiles.try_emplace(uri);
    if (isNew) it->second = readProfile(document, uri);
    node.punctual->profile = it->second;
  }
}

void readSceneLightNotes(GltfDocument& document, Scene& scene) {
  const Json* shown = shownScene(document);
  const Json* note = shown == nullptr ? nullptr : noteOf(*shown, kSceneNote);
  if (note == nullptr) return;
  if (const Json* sky = member(*note, "sky"))
    scene.skyLight = readState(*sky, nodesOfJson(document, scene.nodes));
  const Json* groups = member(*note, "groups");
  if (groups == nullptr) return;
  for (size_t i = 0; i < std::min(groups->size(), kMostGroups); ++i) {
    const Json& json = (*groups)[i];
    LightGroup group{textIn(json, "name"), flagIn(json, "muted", false),
                     flagIn(json, "solo", false)};
    if (!group.name.empty() && findLightGroup(scene, group.name) == nullptr)
      scene.lightGroups.push_back(std::move(group));
  }
}

void saveLightNotes(GltfOutput& out, Json& json, const Node& now, const Node& was,
                    const JsonOfNode& jsonNodes) {
  const auto profileOf = [](const Node& n) { return n.punctual ? n.punctual->profile : nullptr; };
  const auto profile = profileOf(now), before = profileOf(was);
  const auto pictureOf = [](const Node& n) { return n.area ? n.area->picture : nullptr; };
  const auto picture = pictureOf(now);
  const bool stays = isSameFile(profile, before) && isSameFile(picture, pictureOf(was)) &&
                     ((!profile && !picture) || out.isSameFolder());
  // Nodes may be numbered otherwise.
  if (now.light == was.light && stays && now.light.leftOut.empty()) return;
  Json note = stateJson(now.light, jsonNodes);
  if (profile) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(profile->text.data());
    note[kProfile] = uriOfFile(out, profile->file, {bytes, profile->text.size()});
  }
  if (picture) note[kPicture] = uriOfFile(out, picture->file, *picture->bytes);
  eraseNote(json, kNodeNote);
  if (!note.empty()) noteFor(json)[kNodeNote] = std::move(note);
}

void saveSceneLightNotes(GltfOutput& out, const JsonOfNode& jsonNodes) {
  const Scene& now = out.scene;
  if (now.skyLight == out.source.skyLight && now.lightGroups == out.source.lightGroups &&
      now.skyLight.leftOut.empty())
    return;
  if (!out.json.contains("scenes")) return;
  Json& scene = out.json["scenes"][out.json.value("scene", size_t{0})];
  eraseNote(scene, kSceneNote);
  Json note = Json::object();
  if (now.skyLight != LightState()) note["sky"] = stateJson(now.skyLight, jsonNodes);
  for (const LightGroup& group : now.lightGroups) {
    Json json = {{"name", group.name}};
    if (group.muted) json["muted"] = true;
    if (group.solo) json["solo"] = true;
    note["groups"].push_back(std::move(json));
  }
  if (!note.empty()) noteFor(scene)[kSceneNote] = std::move(note);
}

}  // namespace lamplighter
