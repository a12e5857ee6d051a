// The members that are read, as a table: what type each must have, and what it refers to.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include "renderer/scene/gltf/gltf_document.h"

namespace lamplighter {

namespace {

enum class Type { count, index, number, numbers, flag, text, array, textureInfo };

// A member and where it is in an entry of a list: names with a dot between; [] is every entry of
// an array, {} every member of an object.
struct Member {
  std::string_view path;
  Type type;
  const char* list = nullptr;  // which an index refers to
  size_t length = 0;           // of numbers
  bool isRequired = false;
};

constexpr Member required(Member member) {
  member.isRequired = true;
  return member;
}
constexpr Member index(std::string_view path, const char* list) {
  return {path, Type::index, list};
}
constexpr Member count(std::string_view path) { return {path, Type::count}; }
constexpr Member number(std::string_view path) { return {path, Type::number}; }
constexpr Member flag(std::string_view path) { return {path, Type::flag}; }
constexpr Member text(std::string_view path) { return {path, Type::text}; }
constexpr Member numbers(std::string_view path, size_t length) {
  return {path, Type::numbers, nullptr, length};
}

constexpr Member kBuffers[] = {required(count("byteLength")), text("uri")};
constexpr Member kViews[] = {required(index("buffer", "buffers")), required(count("byteLength")),
                             count("byteOffset"), count("byteStride")};
constexpr Member kAccessors[] = {required(count("componentType")),
                                 required(count("count")),
                                 required(text("type")),
                                 count("byteOffset"),
                                 flag("normalized"),
                                 index("bufferView", "bufferViews")};
// Members of sparse.indices and sparse.values.
constexpr Member kSparse[] = {required(count("sparse.count")),
                              required(count("sparse.indices.componentType")),
                              required(index("sparse.indices.bufferView", "bufferViews")),
                              count("sparse.indices.byteOffset"),
                              required(index("sparse.values.bufferView", "bufferViews")),
                              count("sparse.values.byteOffset")};
constexpr Member kImages[] = {index("bufferView", "bufferViews"), text("uri")};
constexpr Member kSamplers[] = {count("wrapS"), count("wrapT"), count("magFilter")};
constexpr Member kTextures[] = {text("name"),
                                index("sampler", "samplers"),
                                index("source", "images"),
                                index("extensions.EXT_texture_webp.source", "images"),
                                index("extensions.KHR_texture_basisu.source", "images"),
                                index("extensions.EXT_texture_avif.source", "images"),
                                index("extensions.MSFT_texture_dds.source", "images")};
constexpr Member kTextureInfo[] = {index("index", "textures"),
                                   count("texCoord"),
                                   number("scale"),
                                   numbers("extensions.KHR_texture_transform.offset", 2),
                                   numbers("extensions.KHR_texture_transform.scale", 2),
                                   number("extensions.KHR_texture_transform.rotation"),
                                   count("extensions.KHR_texture_transform.texCoord")};
constexpr Member kMaterials[] = {
    text("name"),
    numbers("pbrMetallicRoughness.baseColorFactor", 4),
    number("pbrMetallicRoughness.metallicFactor"),
    number("pbrMetallicRoughness.roughnessFactor"),
    {"pbrMetallicRoughness.baseColorTexture", Type::textureInfo},
    {"pbrMetallicRoughness.metallicRoughnessTexture", Type::textureInfo},
    {"normalTexture", Type::textureInfo},
    {"emissiveTexture", Type::textureInfo},
    numbers("emissiveFactor", 3),
    number("extensions.KHR_materials_emissive_strength.emissiveStrength"),
    number("extensions.KHR_materials_transmission.transmissionFactor"),
    text("alphaMode"),
    number("alphaCutoff"),
    flag("doubleSided")};
constexpr Member kMeshes[] = {text("name"),
                              {"weights", Type::array},
                              index("primitives[].attributes{}", "accessors"),
                              index("primitives[].targets[]{}", "accessors"),
                              index("primitives[].indices", "accessors"),
                              index("primitives[].material", "materials"),
                              count("primitives[].mode")};
constexpr Member kCameras[] = {text("name"), number("perspective.yfov"),
                               number("perspective.aspectRatio"), number("perspective.znear"),
                               number("perspective.zfar")};
constexpr Member kSkins[] = {index("joints[]", "nodes"), index("skeleton", "nodes"),
                             index("inverseBindMatrices", "accessors")};
constexpr Member kAnimations[] = {
    index("samplers[].input", "accessors"), index("samplers[].output", "accessors"),
    count("channels[].sampler"), index("channels[].target.node", "nodes")};
constexpr Member kNodes[] = {text("name"),
                             index("mesh", "meshes"),
                             index("camera", "cameras"),
                             index("skin", "skins"),
                             index("children[]", "nodes"),
                             numbers("matrix", 16),
                             numbers("translation", 3),
                             numbers("rotation", 4),
                             numbers("scale", 3),
                             index("extensions.KHR_lights_punctual.light", kPunctualLights),
                             index("extensions.EXT_lights_area.light", kAreaLights),
                             flag("extensions.KHR_node_visibility.visible"),
                             text("extras.lamplighter.areaLight.shape"),
                             numbers("extras.lamplighter.areaLight.radiance", 3),
                             number("extras.lamplighter.areaLight.diameter"),
                             number("extras.lamplighter.areaLight.length"),
                             flag("extras.lamplighter.light.on"),
                             flag("extras.lamplighter.light.solo"),
                             text("extras.lamplighter.light.group"),
                             index("extras.lamplighter.light.leaves_out[]", "nodes"),
                             text("extras.lamplighter.light.profile"),
                             text("extras.lamplighter.light.picture")};
constexpr Member kScenes[] = {text("name"),
                              index("nodes[]", "nodes"),
                              flag("extras.lamplighter.lights.sky.on"),
                              flag("extras.lamplighter.lights.sky.solo"),
                              text("extras.lamplighter.lights.sky.group"),
                              index("extras.lamplighter.lights.sky.leaves_out[]", "nodes"),
                              text("extras.lamplighter.lights.groups[].name"),
                              flag("extras.lamplighter.lights.groups[].muted"),
                              flag("extras.lamplighter.lights.groups[].solo")};
constexpr Member kPunctual[] = {
    text("type"),    numbers("color", 3),           number("intensity"),
    number("range"), number("spot.innerConeAngle"), number("spot.outerConeAngle")};
constexpr Member kArea[] = {text("type"), numbers("color", 3), number("intensity"), number("size"),
                            number("rect.aspect")};

struct List {
  const char* name;
  std::span<const Member> members;
};
constexpr List kLists[] = {
    {"buffers", kBuffers},     {"bufferViews", kViews},      {"accessors", kAccessors},
    {"images", kImages},       {"samplers", kSamplers},      {"textures", kTextures},
    {"materials", kMaterials}, {"meshes", kMeshes},          {"cameras", kCameras},
    {"skins", kSkins},         {"animations", kAnimations},  {"nodes", kNodes},
    {"scenes", kScenes},       {kPunctualLights, kPunctual}, {kAreaLights, kArea},
};

bool isFinite(const Json& value) {
  return value.is_number() &&
         std::abs(value.get<double>()) <= static_cast<double>(std::numeric_limits<float>::max());
}

class EntryCheck {
 public:
  EntryCheck(const GltfDocument& document, At at) : doc_(document), at_(at) {}

  void check(const Json& entry, const Member& member) const { walk(entry, member.path, member); }

 private:
  // Follows `path`, starting at `object`.
  void walk(const Json& object, std::string_view path, const Member& m) const {
    const size_t end = std::min(path.find_first_of(".[{"), path.size());
    const std::string_view key = path.substr(0, end);
    const Json* value = object.is_object() ? find(object, key) : nullptr;
    std::string_view rest = path.substr(end);
    if (value == nullptr) {
      if (m.isRequired) doc_.fail(at_, "has no \"" + std::string(key) + "\"");
      return;
    }
    step(*value, key, rest, m);
  }

  void step(const Json& value, std::string_view key, std::string_view rest, const Member& m) const {
    if (rest.empty()) return leaf(value, key, m);
    if (rest.starts_with('.')) return walk(value, rest.substr(1), m);
    const bool isArray = rest.starts_with("[]");
    if (isArray ? !value.is_array() : !value.is_object()) {
      wrongType(value, key, isArray ? "an array" : "an object");
    }
    rest.remove_prefix(2);
    for (const auto& [name, entry] : value.items()) {
      if (isArray && rest.empty()) {
        amongIndices(entry, key, m);
      } else {
        step(entry, isArray ? key : std::string_view(name), rest, m);
      }
    }
  }

  static const Json* find(const Json& object, std::string_view key) {
    const auto it = object.find(key);
    return it == object.end() ? nullptr : &*it;
  }

  void leaf(const Json& value, std::string_view key, const Member& m) const {
    switch (m.type) {
      case Type::count:
        size(value, key);
        break;
      case Type::index: {
        const size_t count = listOf(doc_, m.list).size();
        if (const size_t i = size(value, key); i >= count) {
          doc_.fail(at_, "has \"" + printable(key) + "\": " + std::to_string(i) +
                             ", but there are " + std::to_string(count));
        }
        break;
      }
      case Type::number:
        if (!isFinite(value)) wrongType(value, key, "a finite number");
        break;
      case Type::numbers:
        if (!value.is_array() || value.size() != m.length ||
            !std::all_of(value.begin(), value.end(), [](const Json& v) { return isFinite(v); })) {
          wrongType(value, key, std::to_string(m.length) + " finite numbers");
        }
        break;
      case Type::flag:
        if (!value.is_boolean()) wrongType(value, key, "true or false");
        break;
      case Type::text:
        if (!value.is_string()) wrongType(value, key, "a string");
        break;
      case Type::array:
        if (!value.is_array()) wrongType(value, key, "an array");
        break;
      case Type::textureInfo:
        for (const Member& part : kTextureInfo) walk(value, part.path, part);
    }
  }

  size_t size(const Json& value, std::string_view key) const {
    const auto number = sizeOf(value);
    if (!number) wrongType(value, key, "a count or an index");
    return *number;
  }

  void amongIndices(const Json& value, std::string_view key, const Member& m) const {
    const size_t count = listOf(doc_, m.list).size();
    const auto number = sizeOf(value);
    if (number && *number < count) return;
    doc_.fail(at_, "has " + printable(value.dump(-1, ' ', false, Json::error_handler_t::replace)) +
                       " among its \"" + std::string(key) + "\", but there are " +
                       std::to_string(count));
  }

  [[noreturn]] void wrongType(const Json& value, std::string_view key,
                              const std::string& expected) const {
    doc_.fail(at_, "has \"" + printable(key) + "\": " +
                       printable(value.dump(-1, ' ', false, Json::error_handler_t::replace)) +
                       ", which is not " + expected);
  }

  const GltfDocument& doc_;
  At at_;
};

}  // namespace

std::optional<size_t> sizeOf(const Json& value) {
  if (value.is_number_unsigned()) return value.get<size_t>();
  // Some exporters write 3.0 where 3 is meant.
  if (value.is_number_float()) {
    const double d = value.get<double>();
    if (!std::signbit(d) && d < 9007199254740992.0 && d == std::floor(d))
      return static_cast<size_t>(d);
  }
  return std::nullopt;
}

void checkMembers(const GltfDocument& document) {
  EntryCheck(document, {"glTF", 0}).check(document.json, count("scene"));
  for (const List& list : kLists) {
    const Json& entries = listOf(document, list.name);
    for (size_t i = 0; i < entries.size(); ++i) {
      const EntryCheck entry(document, {list.name, i});
      for (const Member& member : list.members) entry.check(entries[i], member);
      if (entries[i].contains("sparse")) {
        for (const Member& member : kSparse) entry.check(entries[i], member);
      }
    }
  }
}

}  // namespace lamplighter
