#include <algorithm>
#include <optional>
#include <vector>

#include "renderer/scene/gltf/gltf_lights.h"
#include "renderer/scene/gltf/save/gltf_output.h"

namespace lamplighter {

namespace {

constexpr const char* kPunctual = "KHR_lights_punctual";
constexpr const char* kArea = "EXT_lights_area";

// The light list of an extension; created if necessary.
Json& lights(Json& root, const char* extension) {
  Json& list = extensionObject(root, extension)["lights"];
  if (!list.is_array()) list = Json::array();
  return list;
}

// The JSON of the light to which a node refers, as a starting point; an empty object if it has
// none.
Json lightOf(Json& root, const Json& node, const char* extension) {
  const Json* reference = extensionOf(node, extension);
  const Json* light = reference == nullptr ? nullptr : member(*reference, "light");
  return light == nullptr ? Json::object() : lights(root, extension)[light->get<size_t>()];
}

void refer(GltfOutput& out, Json& node, const char* extension, Json light) {
  Json& list = lights(out.json, extension);
  list.push_back(std::move(light));
  const size_t index = list.size() - 1;
  extensionObject(node, extension)["light"] = index;
  out.useExtension(extension);
}

Json punctualJson(Json json, const PunctualLight& light) {
  const ScaledColor scaled = scaledColor(light.intensity);
  json["type"] = light.kind == PunctualKind::point  ? "point"
                 : light.kind == PunctualKind::spot ? "spot"
                                                    : "directional";
  json["color"] = scaled.color;
  json["intensity"] = scaled.scale;
  json.erase("range");
  if (light.range > 0.0f) json["range"] = toJson(light.range);
  if (light.kind != PunctualKind::spot) {
    json.erase("spot");
  } else {
    json["spot"]["innerConeAngle"] = toJson(light.innerCone);
    json["spot"]["outerConeAngle"] = toJson(light.outerCone);
  }
  return json;
}

Json areaJson(Json json, const AreaLight& light, const AxisRatios& ratios) {
  const ScaledColor scaled = scaledColor(light.radiance);
  const bool isDisk = light.shape == AreaShape::disk;
  json["type"] = isDisk ? "disk" : "rect";
  json["color"] = scaled.color;
  json["intensity"] = scaled.scale;
  const double width = shortestDouble(light.size.x) / ratios.x;
  const double height = shortestDouble(light.size.y) / ratios.y;
  json["size"] = isDisk ? width : height;
  json.erase("rect");
  if (!isDisk) json["rect"]["aspect"] = width / height;
  return json;
}

void savePunctual(GltfOutput& out, Json& json, const Node& now, const Node& was) {
  if (now.punctual == was.punctual) return;
  Json old = lightOf(out.json, json, kPunctual);
  eraseExtension(json, kPunctual);
  if (now.punctual) refer(out, json, kPunctual, punctualJson(std::move(old), *now.punctual));
}

void saveShapeNote(Json& json, const AreaLight& light) {
  const bool isTube = light.shape == AreaShape::tube;
  Json& note = noteFor(json)["areaLight"];
  note = {{"shape", isTube ? "tube" : "sphere"}, {"radiance", toJson(light.radiance)}};
  if (isTube) note["length"] = toJson(light.size.x);
  note["diameter"] = toJson(isTube ? light.size.y : light.size.x);
}

void saveArea(GltfOutput& out, Json& json, const Node& now, const Node& was, const vec3& scaleNow,
              const vec3& scaleWas) {
  const AxisRatios ratios = areaScale(scaleNow);
  const bool isNoted = now.area && isNotedShape(now.area->shape);
  if (now.area == was.area && (isNoted || !now.area || ratios == areaScale(scaleWas))) return;
  Json old = lightOf(out.json, json, kArea);
  eraseExtension(json, kArea);
  eraseNote(json, "areaLight");
  if (!now.area) return;
  if (isNoted) {
    saveShapeNote(json, *now.area);
  } else {
    refer(out, json, kArea, areaJson(std::move(old), *now.area, ratios));
  }
}

// The index of the light to which a node refers. Nodes that are in no scene are not validated when
// a file is read, so their index may be invalid.
std::optional<size_t> lightOf(const Json& node, const char* extension, size_t count) {
  const Json* reference = extensionOf(node, extension);
  const Json* light = reference == nullptr ? nullptr : member(*reference, "light");
  if (light == nullptr || !light->is_number_unsigned()) return std::nullopt;
  const size_t index = light->get<size_t>();
  return index < count ? std::optional(index) : std::nullopt;
}

std::vector<bool> lightsInUse(const Json& root, const char* extension) {
  const Json* list = extensionOf(root, extension);
  list = list == nullptr ? nullptr : member(*list, "lights");
  std::vector<bool> used(list == nullptr ? 0 : list->size(), false);
  const Json* nodes = member(root, "nodes");
  if (nodes == nullptr) return used;
  for (const Json& node : *nodes) {
    if (const auto light = lightOf(node, extension, used.size())) used[*light] = true;
  }
  return used;
}

// Removes lights that are no longer used by any node, so that they do not accumulate. Lights that
// were unused in the source stay.
void dropOrphans(GltfOutput& out, const char* extension) {
  const std::vector<bool> before = lightsInUse(out.source.document.json, extension);
  const std::vector<bool> after = lightsInUse(out.json, extension);
  // Animations may refer to lights by index, with JSON pointers.
  if (after.empty() || out.source.document.usesExtension("KHR_animation_pointer")) return;
  Json kept = Json::array();
  std::vector<size_t> map;
  Json& list = lights(out.json, extension);
  for (size_t i = 0; i < after.size(); ++i) {
    const bool stays = after[i] || (i < before.size() && !before[i]);
    map.push_back(kept.size());
    if (stays) kept.push_back(list[i]);
  }
  if (kept.size() == list.size()) return;
  for (Json& node : out.json["nodes"]) {
    if (const auto light = lightOf(node, extension, map.size()))
      node["extensions"][extension]["light"] = map[*light];
  }
  list = std::move(kept);
  if (!list.empty()) return;
  eraseExtension(out.json, extension);  // glTF has no empty lists
  for (const char* names : {"extensionsUsed", "extensionsRequired"}) {
    if (!out.json.contains(names)) continue;
    Json& used = out.json[names];
    const auto it = std::find(used.begin(), used.end(), Json(extension));
    if (it != used.end()) used.erase(it);
    if (used.empty()) out.json.erase(names);
  }
}

}  // namespace

void saveLights(GltfOutput& out, const std::vector<size_t>& jsonNodes) {
  Scene loaded;
  loaded.nodes = out.source.nodes;
  const std::vector<mat4> worldNow = worldMatrices(out.scene), worldWas = worldMatrices(loaded);
  std::vector<size_t> bySource(listOf(out.source.document, "nodes").size(), SIZE_MAX);
  for (size_t i = 0; i < loaded.nodes.size(); ++i) {
    bySource[static_cast<size_t>(loaded.nodes[i].sourceNode)] = i;
  }
  JsonOfNode indices;
  for (size_t i = 0; i < out.scene.nodes.size(); ++i) indices[out.scene.nodes[i].id] = jsonNodes[i];
  const Node none;
  for (size_t i = 0; i < out.scene.nodes.size(); ++i) {
    const Node& now = out.scene.nodes[i];
    const auto source = static_cast<size_t>(now.sourceNode);
    const bool known =
        now.sourceNode >= 0 && source < bySource.size() && bySource[source] != SIZE_MAX;
    const Node& was = known ? loaded.nodes[bySource[source]] : none;
    const mat4& before = known ? worldWas[bySource[source]] : worldNow[i];
    Json& json = out.json["nodes"][jsonNodes[i]];
    savePunctual(out, json, now, was);
    saveLightNotes(out, json, now, was, indices);
    saveArea(out, json, now, was, axisLengths(worldNow[i]), axisLengths(before));
  }
  dropOrphans(out, kPunctual);
  dropOrphans(out, kArea);
  saveSceneLightNotes(out, indices);
}

}  // namespace lamplighter
