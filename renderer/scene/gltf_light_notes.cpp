// What glTF has no place for about lights: extras.lamplighter.light of a node (on, solo, group, and
// the file of its profile) and extras.lamplighter.lights of the scene (groups, the sky's state).
#include <algorithm>
#include <map>

#include "renderer/error.h"
#include "renderer/scene/gltf_content.h"
#include "renderer/scene/gltf_output.h"
#include "renderer/scene/ies_profile.h"

namespace lamplighter {

namespace {

constexpr const char* kNodeNote = "light";
constexpr const char* kSceneNote = "lights";
constexpr const char* kProfile = "profile";
constexpr size_t kMostGroups = 10'000;

LightState readState(const GltfDocument& document, const Json& note, At at) {
  LightState state;
  state.on = boolMember(document, note, "on", true, at);
  state.solo = boolMember(document, note, "solo", false, at);
  state.group = textMember(document, note, "group", at);
  return state;
}

Json stateJson(const LightState& state) {
  Json json = Json::object();
  if (!state.on) json["on"] = false;
  if (state.solo) json["solo"] = true;
  if (!state.group.empty()) json["group"] = state.group;
  return json;
}

const Json* shownScene(const GltfDocument& document) {
  const Json& scenes = listOf(document, "scenes");
  if (scenes.empty()) return nullptr;
  return &scenes[sizeMember(document, document.json, "scene", {"scenes", 0}).value_or(0)];
}

// One that cannot be had is left out with a warning: the light is a plain one then.
std::shared_ptr<const IesProfile> readProfile(GltfDocument& document, const std::string& uri) {
  std::string why;
  const Bytes bytes = readUri(document, uri, why);
  if (bytes == nullptr) {
    document.warn("a light's profile \"" + printable(uri) + "\" " + why + "; it shines without");
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

}  // namespace

void readLightNotes(GltfDocument& document, std::vector<Node>& nodes) {
  std::map<std::string, std::shared_ptr<const IesProfile>> profiles;
  for (Node& node : nodes) {
    const auto index = static_cast<size_t>(node.sourceNode);
    const Json* note = noteOf(listOf(document, "nodes")[index], kNodeNote);
    if (note == nullptr || !note->is_object()) continue;
    node.light = readState(document, *note, {"nodes", index});
    const std::string uri = textMember(document, *note, kProfile, {"nodes", index});
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
  const At at{"scenes", 0};
  if (const Json* sky = member(*note, "sky")) scene.skyLight = readState(document, *sky, at);
  const Json* groups = member(*note, "groups");
  if (groups == nullptr || !groups->is_array()) return;
  for (size_t i = 0; i < std::min(groups->size(), kMostGroups); ++i) {
    const Json& json = (*groups)[i];
    LightGroup group{textMember(document, json, "name", at),
                     boolMember(document, json, "muted", false, at),
                     boolMember(document, json, "solo", false, at)};
    if (!group.name.empty() && findLightGroup(scene, group.name) == nullptr)
      scene.lightGroups.push_back(std::move(group));
  }
}

void saveLightNotes(GltfOutput& out, Json& json, const Node& now, const Node& was) {
  const auto profileOf = [](const Node& n) { return n.punctual ? n.punctual->profile : nullptr; };
  const auto profile = profileOf(now), before = profileOf(was);
  const bool sameProfile = profile == before || (profile && before && *profile == *before);
  const bool stays = sameProfile && (!profile || out.isSameFolder());
  if (now.light == was.light && stays) return;
  Json note = stateJson(now.light);
  if (profile) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(profile->text.data());
    note[kProfile] = uriOfFile(out, profile->file, {bytes, profile->text.size()});
  }
  eraseNote(json, kNodeNote);
  if (!note.empty()) noteFor(json)[kNodeNote] = std::move(note);
}

void saveSceneLightNotes(GltfOutput& out) {
  const Scene& now = out.scene;
  if (now.skyLight == out.source.skyLight && now.lightGroups == out.source.lightGroups) return;
  if (!out.json.contains("scenes")) return;
  Json& scene = out.json["scenes"][out.json.value("scene", size_t{0})];
  eraseNote(scene, kSceneNote);
  Json note = Json::object();
  if (now.skyLight != LightState()) note["sky"] = stateJson(now.skyLight);
  for (const LightGroup& group : now.lightGroups) {
    Json json = {{"name", group.name}};
    if (group.muted) json["muted"] = true;
    if (group.solo) json["solo"] = true;
    note["groups"].push_back(std::move(json));
  }
  if (!note.empty()) noteFor(scene)[kSceneNote] = std::move(note);
}

}  // namespace lamplighter
